test_binary(viewer
  SOURCES ../support/worker_main.cpp frame_times_test.cpp navigation_test.cpp ratings_file_test.cpp
          review_job_test.cpp review_keys_test.cpp review_state_test.cpp reviewed_asset_test.cpp
          reviewed_scene_test.cpp
  ALONE signal_job_test.cpp
  LINK viewer nlohmann_json::nlohmann_json
  LABELS gpu)
# Real keys and a real mouse on a virtual display. Libraries of displays keep memory that leak checks would complain of.
if(NOT SCENE_ANALYZER_SANITIZE)
  find_program(PYTHON3 python3 REQUIRED)
  add_test(NAME Window.KeysMouseAndWindow
    COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/viewer/window_test.py $<TARGET_FILE:scene-analyzer>)
  set_tests_properties(Window.KeysMouseAndWindow PROPERTIES
    ENVIRONMENT SCENE_ANALYZER_VALIDATION=1 LABELS gpu TIMEOUT 600 RUN_SERIAL TRUE)
endif()
