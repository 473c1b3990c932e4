# lockstep_check_recording(NAME RECORDING SHARDS N [PROGRAM lockstep] [OPTIONS OPTION...])
#
# Tells CTest of N tests that check a part of a recording's frames each, NAME.1 to NAME.N, which `ctest -j` runs side by
# side, and of one that joins them, NAME.merge: its report and its result are those of one check of the whole recording
# (docs/shards.md). A part that did not run leaves no file, and without all of them NAME.merge fails. OPTIONS are those of
# `lockstep check --trace`. Every part has one thread; the reports lie in NAME.parts in the build folder.
function(lockstep_check_recording name recording)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "SHARDS;PROGRAM" "OPTIONS")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES OR NOT arg_SHARDS MATCHES "^[1-9][0-9]*$")
    message(FATAL_ERROR "lockstep_check_recording: ${arg_UNPARSED_ARGUMENTS}${arg_KEYWORDS_MISSING_VALUES}: right is "
                        "lockstep_check_recording(NAME RECORDING SHARDS N [PROGRAM lockstep] [OPTIONS OPTION...])")
  endif()
  if(NOT arg_PROGRAM)
    find_program(LOCKSTEP_PROGRAM lockstep REQUIRED)
    set(arg_PROGRAM ${LOCKSTEP_PROGRAM})
  endif()
  cmake_path(ABSOLUTE_PATH recording BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name}.parts)
  file(MAKE_DIRECTORY ${folder})
  set(files)
  set(parts)
  foreach(shard RANGE 1 ${arg_SHARDS})
    list(APPEND files ${folder}/${shard}.json)
    list(APPEND parts ${name}.${shard})
    add_test(NAME ${name}.${shard} COMMAND ${arg_PROGRAM} check --trace ${recording} --shard ${shard}/${arg_SHARDS}
                                           --threads 1 --json ${folder}/${shard}.json ${arg_OPTIONS})
  endforeach()
  add_test(NAME ${name}.clean COMMAND ${CMAKE_COMMAND} -E rm -f ${files} ${folder}/whole.json ${folder}/whole.xml)
  add_test(NAME ${name}.merge COMMAND ${arg_PROGRAM} merge ${files} --json ${folder}/whole.json
                                      --junit ${folder}/whole.xml)
  # What an earlier run left is gone before the first part starts; a part that fails still has its say in the whole.
  set_tests_properties(${name}.clean PROPERTIES FIXTURES_SETUP ${name})
  set_tests_properties(${parts} ${name}.merge PROPERTIES FIXTURES_REQUIRED ${name})
  set_tests_properties(${name}.merge PROPERTIES DEPENDS "${parts}")
endfunction()
