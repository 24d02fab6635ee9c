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

# The same by pkg-config alone, as in a Makefile, and under a sanitizer, which would allocate vectors in another way.
find_program(bash bash REQUIRED)
file(GLOB_RECURSE pc "${prefix}/*/seiche.pc")
cmake_path(GET pc PARENT_PATH pc_folder)
set(ENV{PKG_CONFIG_PATH} "${pc_folder}:$ENV{PKG_CONFIG_PATH}")
foreach(variant IN ITEMS "plain" "checked;-fsanitize=address")
  list(POP_FRONT variant name)
  execute_process(COMMAND "${bash}" -c
    "'${compiler}' ${variant} '${CMAKE_CURRENT_LIST_DIR}/main.cpp' -o '${work}/${name}' $(pkg-config --cflags --libs seiche)"
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
# Other instructions change how Eigen frees what the library has allocated: that is said before anything runs.
if(CMAKE_HOST_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  foreach(instructions IN ITEMS sse3 avx512f)
    execute_process(COMMAND "${bash}" -c
      "'${compiler}' -m${instructions} -fsyntax-only '${CMAKE_CURRENT_LIST_DIR}/main.cpp' $(pkg-config --cflags seiche)"
      RESULT_VARIABLE result_${instructions} ERROR_VARIABLE errors)
    string(FIND "${errors}" "would free vectors of Eigen in another way than the Seiche library" said_${instructions})
  endforeach()
  if(result_sse3 EQUAL result_avx512f OR said_sse3 EQUAL said_avx512f)
    message(FATAL_ERROR "a program for AVX-512 and one for SSE3 are both accepted, or both refused")
  endif()
endif()
cmake_path(GET pc_folder PARENT_PATH library_folder)
set(ENV{LD_LIBRARY_PATH} "${library_folder}:$ENV{LD_LIBRARY_PATH}")  # of a shared library
set(ENV{ASAN_OPTIONS} detect_leaks=0)  # what other libraries keep until the end is not asked here

find_program(consumer consumer PATHS "${work}/consumer" "${work}/consumer/${config}" NO_DEFAULT_PATH REQUIRED)
find_program(program seiche PATHS "${prefix}/bin" NO_DEFAULT_PATH REQUIRED)
foreach(command IN ITEMS "${consumer}" "${work}/plain" "${work}/checked" "${program};--version")
  execute_process(COMMAND ${command} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  string(FIND "${output}" "${version}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "'${command}' printed '${output}', which does not name version ${version}")
  endif()
endforeach()

# What bash completes, as the shell asks for it.
foreach(typed IN ITEMS "seiche re;recover resume" "seiche run --thr;--threads" "seiche new kl;klein_gordon"
    "seiche run x --set method.name=egc8;egc8" "seiche run x --set method.na;method.name="
    "seiche run x --set time.end=1 backend.plan=m;measure" "seiche converge x --methods crkn;crkn4 crkn6")
  list(GET typed 0 words)
  list(GET typed 1 wanted)
  execute_process(COMMAND "${bash}" -c "PATH='${prefix}/bin':$PATH; source '${prefix}/share/bash-completion/completions/seiche'
    COMP_LINE='${words}'; COMP_POINT=\${#COMP_LINE}; COMP_WORDS=(${words}); COMP_CWORD=$((\${#COMP_WORDS[@]} - 1)); _seiche; sort <<<\"$(printf '%s\\n' \"\${COMPREPLY[@]}\")\" | xargs"
    OUTPUT_VARIABLE completed OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  if(NOT completed STREQUAL wanted)
    message(FATAL_ERROR "'${words}' is completed to '${completed}' and not to '${wanted}'")
  endif()
endforeach()
foreach(page LICENSE README.md CHANGELOG.md examples/own_potential.cpp)
  if(NOT EXISTS "${prefix}/share/doc/seiche/${page}")
    message(FATAL_ERROR "share/doc/seiche has no ${page}")
  endif()
endforeach()
find_program(help2man help2man)
if(help2man)
  file(READ "${prefix}/share/man/man1/seiche.1" manual)
  if(NOT manual MATCHES "energy\\\\-stable integrators" OR NOT manual MATCHES "recover")
    message(FATAL_ERROR "the manual does not say what seiche is, or not its commands")
  endif()
endif()

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
