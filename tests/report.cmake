test_binary(report
  SOURCES fixture.cpp glb_scene.cpp csv_test.cpp defect_table_test.cpp glb_import_test.cpp glb_limits_test.cpp glb_test.cpp
          histogram_test.cpp json_test.cpp signal_test.cpp terminal_text_test.cpp write_file_test.cpp
          ../support/hooked_sync.cpp
  ALONE glb_placement_test.cpp table_test.cpp
  LINK report assimp::assimp fmt::fmt nlohmann_json::nlohmann_json)
