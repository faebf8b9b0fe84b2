# Configures a project that stands outside of Grandstand, and if `SAYS` names a program builds and runs its `decide`, which
# must say what that program says. With `INSTALL` it finds what that build installs, its `COMPONENTS`, into a folder
# of the test's own. In the file `forced` each project leaves the options that it got with the libraries: there are none.
file(REMOVE_RECURSE ${FOLDER})

function(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

if(INSTALL)
  foreach(component ${COMPONENTS})
    step(${CMAKE_COMMAND} --install ${INSTALL} --component ${component} --prefix ${FOLDER}/prefix)
  endforeach()
endif()
string(REPLACE ";" "\\;" components "${COMPONENTS}")
step(${CMAKE_COMMAND} -S ${PROJECT} -B ${FOLDER}/build -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release
     -DGRANDSTAND=${GRANDSTAND} -DGRANDSTAND_VERSION=${VERSION} -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
     "-DCOMPONENTS=${components}" "-DCMAKE_EXE_LINKER_FLAGS=${LINKER_FLAGS}" ${OPTIONS})
file(READ ${FOLDER}/build/forced forced)
if(forced)
  message(FATAL_ERROR "who links Grandstand gets ${forced}")
endif()
if(SAYS)
  step(${CMAKE_COMMAND} --build ${FOLDER}/build)
  execute_process(COMMAND ${SAYS} OUTPUT_VARIABLE expected COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${FOLDER}/build/decide OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
  if(expected STREQUAL "" OR NOT found STREQUAL expected)
    message(FATAL_ERROR "found\n${found}expected\n${expected}")
  endif()
endif()
