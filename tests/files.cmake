test_binary(files
  SOURCES ../support/hooked_sync.cpp file_test.cpp helper_program_test.cpp replace_test.cpp temporary_name_test.cpp
  LINK files)
add_executable(find_helper_program files/find_helper_program.cpp)
target_include_directories(find_helper_program PRIVATE ${CMAKE_SOURCE_DIR}/src/host)
target_link_libraries(find_helper_program PRIVATE files)
add_dependencies(files_test find_helper_program)
target_compile_definitions(files_test PRIVATE FIND_HELPER_PROGRAM="$<TARGET_FILE:find_helper_program>")
