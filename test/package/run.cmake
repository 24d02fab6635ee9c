# Installs `build` into a fresh prefix, builds the project beside this file and the examples against it, and runs them all.
set(CMAKE_EXECUTE_PROCESS_COMMAND_ECHO STDOUT)
set(work "${build}/package")
set(prefix "${work}/prefix")
file(REMOVE_RECURSE "${work}")

execute_process(COMMAND "${CMAKE_COMMAND}" --install "${build}" --config "${config}" --prefix "${prefix}"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# An installed package may be moved, so none of its CMake files names the tree it was made from.
file(GLOB_RECURSE package_files "${prefix}/*.cmake")
foreach(file IN LISTS package_files)
  file(READ "${file}" text)
  string(FIND "${text}" "${source}/" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} names the source tree ${source}")
  endif()
endforeach()

execute_process(COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${work}/consumer" -G "${generator}"
  -D "CMAKE_BUILD_TYPE=${config}" -D "CMAKE_CXX_COMPILER=${compiler}" -D "CMAKE_PREFIX_PATH=${prefix}"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${work}/consumer" --config "${config}" COMMAND_ERROR_IS_FATAL ANY)

find_program(consumer consumer PATHS "${work}/consumer" "${work}/consumer/${config}" NO_DEFAULT_PATH REQUIRED)
find_program(program seiche PATHS "${prefix}/bin" NO_DEFAULT_PATH REQUIRED)
foreach(command IN ITEMS "${consumer}" "${program};--version")
  execute_process(COMMAND ${command} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  string(FIND "${output}" "${version}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "'${command}' printed '${output}', which does not name version ${version}")
  endif()
endforeach()

# The loader takes an empty entry of a search path for the current folder.
find_program(readelf readelf)
if(readelf)
  execute_process(COMMAND "${readelf}" -d "${program}" OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "R(UN)?PATH[^\n]*" paths "${dynamic}")
  if(paths MATCHES "(\\[|:)(:|\\])")
    message(FATAL_ERROR "${program} looks for libraries in the current folder: ${paths}")
  endif()
endif()

# Each example says at its end what it prints.
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${source}/examples" -B "${work}/examples" -G "${generator}"
  -D "CMAKE_BUILD_TYPE=${config}" -D "CMAKE_CXX_COMPILER=${compiler}" -D "CMAKE_PREFIX_PATH=${prefix}"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${work}/examples" --config "${config}" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB examples "${source}/examples/*.cpp")
foreach(example IN LISTS examples)
  cmake_path(GET example STEM name)
  find_program(program_${name} ${name} PATHS "${work}/examples" "${work}/examples/${config}" NO_DEFAULT_PATH REQUIRED)
  execute_process(COMMAND "${program_${name}}" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  file(READ "${example}" text)
  if(NOT text MATCHES "\n// It prints:\n(.*)$")
    message(FATAL_ERROR "${example} does not say what it prints")
  endif()
  string(REGEX REPLACE "//   " "" claim "${CMAKE_MATCH_1}")
  if(NOT output STREQUAL claim)
    message(FATAL_ERROR "${example} says that it prints\n${claim}but it printed\n${output}")
  endif()
endforeach()
