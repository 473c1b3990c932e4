# lockstep_discover_tests(TARGET [WORKING_DIRECTORY DIR] [TEST_PREFIX TEXT] [PROPERTIES NAME VALUE...])
#
# Tells CTest of each test of a program, by the framework that the target is linked with: Catch2, GoogleTest or doctest
# (docs/unit_tests.md). A program with none of them is one test. Tests run in DIR, by default the folder of the
# CMakeLists.txt; a skip (exit status 77) is shown as one; OpenMP's threads sleep while they wait.
function(lockstep_discover_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "WORKING_DIRECTORY;TEST_PREFIX" "PROPERTIES")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "lockstep_discover_tests: ${arg_UNPARSED_ARGUMENTS}${arg_KEYWORDS_MISSING_VALUES}: right is "
                        "lockstep_discover_tests(TARGET [WORKING_DIRECTORY DIR] [TEST_PREFIX TEXT] [PROPERTIES NAME VALUE...])")
  endif()
  if(NOT TARGET ${target})
    message(FATAL_ERROR "lockstep_discover_tests: ${target} is no target; it is to be made before, by add_executable")
  endif()
  if(NOT arg_WORKING_DIRECTORY)
    set(arg_WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  set(options WORKING_DIRECTORY ${arg_WORKING_DIRECTORY} TEST_PREFIX "${arg_TEST_PREFIX}"
              PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT OMP_WAIT_POLICY=passive ${arg_PROPERTIES})
  get_target_property(libraries ${target} LINK_LIBRARIES)
  if("${libraries}" MATCHES "Catch2::")
    include(${Catch2_DIR}/Catch.cmake)
    # Without the first word newer ones take Catch2's own code of skipped tests.
    catch_discover_tests(${target} SKIP_IS_FAILURE ${options})
  elseif("${libraries}" MATCHES "GTest::")
    include(GoogleTest)
    gtest_discover_tests(${target} ${options})
  elseif("${libraries}" MATCHES "doctest::")
    include(${doctest_DIR}/doctest.cmake)
    doctest_discover_tests(${target} ${options})
  else()
    add_test(NAME "${arg_TEST_PREFIX}${target}" COMMAND ${target} WORKING_DIRECTORY ${arg_WORKING_DIRECTORY})
    set_tests_properties("${arg_TEST_PREFIX}${target}"
      PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT OMP_WAIT_POLICY=passive ${arg_PROPERTIES})
  endif()
endfunction()
