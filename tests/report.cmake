test_binary(report
  SOURCES fixture.cpp csv_test.cpp histogram_test.cpp json_test.cpp signal_test.cpp table_test.cpp terminal_text_test.cpp write_file_test.cpp
          ../support/hooked_sync.cpp
  LINK report fmt::fmt nlohmann_json::nlohmann_json)
