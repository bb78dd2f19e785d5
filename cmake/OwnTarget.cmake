# scree_own_target(<target>): what scree's own tests, examples and benchmarks are compiled with.
# A project that uses scree gets none of it.

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(SCREE_CCACHE ccache)
  mark_as_advanced(SCREE_CCACHE)
  if(SCREE_CCACHE)
    # The sloppiness is what ccache's manual asks for with precompiled headers; base folder and no hashed
    # working folder let two checkouts profit from each other.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${SCREE_CCACHE}
    )
  endif()
endif()

function(scree_own_target target)
  target_link_libraries(${target} PRIVATE scree::scree)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  # No program here reads errno after a root or traps on floating-point flags. Without these two, GCC spares the
  # select() of the contact laws its branch-free form: a third of the time of a step. No result changes.
  target_compile_options(${target} PRIVATE -fno-math-errno -fno-trapping-math)
  # What is fused is said in the source (multiply_add): a compiler's own choice depends on what stands beside it, and an
  # extension of a law that is null would not be the law to the bit. Costs at most 2 % of a step.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # Boost's own headers include deprecated ones of Boost, and would say so in every file.
  target_compile_definitions(${target} PRIVATE BOOST_ALLOW_DEPRECATED_HEADERS)
  if(SCREE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SCREE_ARCH)
    target_compile_options(${target} PRIVATE -march=${SCREE_ARCH})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC 12 finds its own AVX-512 intrinsics uninitialised. It also copies a register of 64 bytes by halves, and then
      # waits for both when they are read as one: a tenth of the time of a step.
      target_compile_options(${target} PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized -mmove-max=512 -mstore-max=512)
    endif()
  endif()
endfunction()
