# cmake -D WAY=find_package|add_subdirectory ... -P use.cmake: configures, builds and runs the outside project.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
if(WAY STREQUAL "find_package")
  # A second folder shows that nothing of the first install place is written into the package.
  run(${CMAKE_COMMAND} --install ${SCREE_BUILD} --prefix ${WORK}/installed)
  file(RENAME ${WORK}/installed ${WORK}/moved)
  set(where -D CMAKE_PREFIX_PATH=${WORK}/moved)
else()
  set(where -D SCREE_SOURCE=${SCREE_SOURCE})
endif()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${WORK}/build -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} ${where}
)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
