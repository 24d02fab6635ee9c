# Writes a test of ctest for each suite of a program of GoogleTest. -D tests=PROGRAM -D filter=FILTER -D suites=FILE
execute_process(COMMAND "${tests}" --gtest_list_tests "--gtest_filter=${filter}"
  OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${tests} does not list its tests: ${failed}")
endif()
string(REGEX REPLACE "#[^\n]*" "" listed "${listed}")  # values of parameters
string(REGEX MATCHALL "[A-Za-z0-9_/]+\\.[ ]*\n" names "${listed}")
set(text "")
foreach(name IN LISTS names)
  string(STRIP "${name}" name)
  string(REGEX REPLACE "\\.$" "" name "${name}")
  set(cost 1)
  if(name MATCHES "/")  # with values, such as every method: the longest, which begin first
    set(cost 100)
  endif()
  string(APPEND text "add_test(${name} \"${tests}\" \"--gtest_filter=${name}.*${filter}\")\n"
    "set_tests_properties(${name} PROPERTIES TIMEOUT 600 COST ${cost})\n")
endforeach()
file(WRITE "${suites}" "${text}")
