test_binary(faults
  SOURCES fault_test.cpp fault_rules_test.cpp device_lost_test.cpp disk_test.cpp interrupts_test.cpp library_faults_test.cpp out_of_memory_test.cpp ../cli/run_program.cpp
  LINK cli nlohmann_json::nlohmann_json util
  LABELS gpu)
# The layer is opened by Vulkan's loader, which finds it through the manifest.
add_library(fault_layer MODULE faults/fault_layer.cpp)
target_include_directories(fault_layer PRIVATE ${CMAKE_SOURCE_DIR}/tests)
target_link_libraries(fault_layer PRIVATE Vulkan::Headers)
file(GENERATE OUTPUT ${test_layers}/fault_layer.json INPUT ${CMAKE_CURRENT_SOURCE_DIR}/faults/fault_layer.json.in)
add_dependencies(faults_test scene-analyzer fault_layer)
target_compile_definitions(faults_test PRIVATE ${run_program_definitions})
# The window's faults, on a virtual display.
if(NOT SCENE_ANALYZER_SANITIZE)
  add_test(NAME Window.Faults
    COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/viewer/window_faults_test.py $<TARGET_FILE:scene-analyzer> ${test_layers})
  set_tests_properties(Window.Faults PROPERTIES LABELS gpu TIMEOUT 600 RUN_SERIAL TRUE)
endif()
