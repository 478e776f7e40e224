test_binary(import
  SOURCES ../support/worker_main.cpp ../../fuzz/mutate.cpp corpus_test.cpp file_names_test.cpp files_test.cpp hostile_test.cpp gltf_extensions_test.cpp gltf_test.cpp ply_stl_test.cpp
          named_import_test.cpp reference_test.cpp scene_test.cpp text_test.cpp texture_decoder_test.cpp wire_test.cpp
  ALONE texture_test.cpp worker_test.cpp
  LINK import nlohmann_json::nlohmann_json)
target_include_directories(import_test PRIVATE ${CMAKE_SOURCE_DIR}/fuzz)
