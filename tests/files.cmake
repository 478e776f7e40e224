test_binary(files
  SOURCES ../support/hooked_sync.cpp file_test.cpp replace_test.cpp temporary_name_test.cpp
  LINK files)
