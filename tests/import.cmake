test_binary(import
  SOURCES ../support/worker_main.cpp corpus_test.cpp files_test.cpp gltf_extensions_test.cpp gltf_test.cpp ply_stl_test.cpp
          reference_test.cpp scene_test.cpp text_test.cpp texture_decoder_test.cpp texture_test.cpp wire_test.cpp worker_test.cpp
  LINK import nlohmann_json::nlohmann_json)
