test_binary(library
  SOURCES ../support/worker_main.cpp asset_list_test.cpp journal_test.cpp merge_test.cpp profile_test.cpp shards_test.cpp
  LINK library nlohmann_json::nlohmann_json
  LABELS gpu)
