test_binary(service
  SOURCES ../support/worker_main.cpp admission_test.cpp content_store_room_test.cpp content_store_test.cpp root_folder_test.cpp token_list_test.cpp
          upload_space_test.cpp uploads_test.cpp
  LINK service
  LABELS gpu)
