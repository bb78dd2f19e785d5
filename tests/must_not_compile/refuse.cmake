# cmake -D MODE=PRECOMPILE|REFUSE|ACCEPT -D SOURCE=... -D COMPILER=... -D COMPILER_ID=... -D INCLUDES=...
#       -D PRECOMPILED=... -P refuse.cmake
# PRECOMPILED is the header that every SOURCE includes first; in the mode PRECOMPILE it is made from SOURCE.
set(flags -std=c++20)
list(TRANSFORM INCLUDES PREPEND -I)
if(COMPILER_ID STREQUAL "GNU") # quoted source lines could hold the expected words
  set(binary ${PRECOMPILED}.gch)
  set(use -include ${PRECOMPILED})
  list(APPEND flags -fno-diagnostics-show-caret)
else()
  set(binary ${PRECOMPILED}.pch)
  set(use -include-pch ${binary})
  list(APPEND flags -fno-caret-diagnostics)
endif()

if(MODE STREQUAL "PRECOMPILE")
  file(WRITE ${PRECOMPILED} "#include \"${SOURCE}\"\n")
  execute_process(COMMAND ${COMPILER} ${flags} ${INCLUDES} -x c++-header ${PRECOMPILED} -o ${binary}
    COMMAND_ERROR_IS_FATAL ANY
  )
  return()
endif()

execute_process(COMMAND ${COMPILER} ${flags} -fsyntax-only ${INCLUDES} ${use} ${SOURCE}
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output
)

if(MODE STREQUAL "ACCEPT")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${SOURCE} should compile, but:\n${output}")
  endif()
  return()
endif()

file(STRINGS ${SOURCE} first LIMIT_COUNT 1)
if(NOT first MATCHES "^// expect: (.+)$")
  message(FATAL_ERROR "${SOURCE} does not begin with '// expect: REGULAR EXPRESSION'")
endif()
set(expected "${CMAKE_MATCH_1}")
if(result EQUAL 0)
  message(FATAL_ERROR "${SOURCE} compiles, but should be refused with: ${expected}")
endif()
string(REGEX REPLACE "[][;]" " " lines "${output}") # these mean something in a list
string(REPLACE "\n" ";" lines "${lines}")
foreach(line IN LISTS lines)
  if(line MATCHES "${expected}")
    return()
  endif()
endforeach()
message(FATAL_ERROR "${SOURCE} is refused, but no line of the message matches: ${expected}\n${output}")
