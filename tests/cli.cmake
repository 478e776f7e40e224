test_binary(cli
  SOURCES option_parsing_test.cpp analyze_options_test.cpp interrupt_test.cpp messages_test.cpp
          selftest_test.cpp
          run_program.cpp analyze_test.cpp defects_test.cpp histograms_test.cpp signals_test.cpp pictures_test.cpp
          bad_input_test.cpp batch_test.cpp check_test.cpp library_progress_test.cpp
          commands_test.cpp device_limit_test.cpp export_test.cpp
  ALONE picture_options_test.cpp
  LINK cli reference test_meshes nlohmann_json::nlohmann_json PkgConfig::cairo util)
# The layer is opened by Vulkan's loader, which finds it through the manifest.
set(test_layers ${CMAKE_BINARY_DIR}/test-layers)
add_library(small_device_layer MODULE cli/small_device_layer.cpp)
target_include_directories(small_device_layer PRIVATE ${CMAKE_SOURCE_DIR}/tests)
target_link_libraries(small_device_layer PRIVATE Vulkan::Headers)
file(GENERATE OUTPUT ${test_layers}/small_device_layer.json INPUT ${CMAKE_CURRENT_SOURCE_DIR}/cli/small_device_layer.json.in)
add_dependencies(cli_test scene-analyzer small_device_layer)
set(run_program_definitions
  SCENE_ANALYZER_BINARY="$<TARGET_FILE:scene-analyzer>"
  SCENE_ANALYZER_TEST_CACHE="${CMAKE_BINARY_DIR}/test-cache"
  SCENE_ANALYZER_TEST_LAYERS="${test_layers}")
target_compile_definitions(cli_test PRIVATE ${run_program_definitions})
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
add_test(NAME CiPage COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tests/gate/ci_page.py
         $<TARGET_FILE:scene-analyzer> ${CMAKE_SOURCE_DIR}/docs/ci.md)
set_tests_properties(CiPage PROPERTIES LABELS gpu TIMEOUT 120)
# These need the limit of the import's memory, which a sanitizer build does not have.
if(NOT SCENE_ANALYZER_SANITIZE)
  add_test(NAME HostileFiles
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tests/cli/hostile_files.py $<TARGET_FILE:scene-analyzer>)
  set_tests_properties(HostileFiles PROPERTIES LABELS gpu TIMEOUT 900)
  add_test(NAME OldKernel
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tests/cli/old_kernel.py $<TARGET_FILE:scene-analyzer>)
  set_tests_properties(OldKernel PROPERTIES LABELS gpu TIMEOUT 60 SKIP_RETURN_CODE 77)
  # The collection lies beside the repository, where it is there at all.
  add_test(NAME BadAssets COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/script/try-assets
           --program $<TARGET_FILE:scene-analyzer> ${CMAKE_SOURCE_DIR}/../shared/assets/bad)
  set_tests_properties(BadAssets PROPERTIES LABELS gpu TIMEOUT 900 SKIP_RETURN_CODE 77)
endif()
