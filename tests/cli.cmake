test_binary(cli
  SOURCES option_parsing_test.cpp analyze_options_test.cpp interrupt_test.cpp messages_test.cpp
          selftest_test.cpp
          run_program.cpp analyze_test.cpp histograms_test.cpp bad_input_test.cpp commands_test.cpp
  LINK cli reference nlohmann_json::nlohmann_json util)
add_dependencies(cli_test scene-analyzer)
target_compile_definitions(cli_test PRIVATE
  SCENE_ANALYZER_BINARY="$<TARGET_FILE:scene-analyzer>"
  SCENE_ANALYZER_TEST_CACHE="${CMAKE_BINARY_DIR}/test-cache")
