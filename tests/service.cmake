test_binary(service
  SOURCES ../support/worker_main.cpp admission_test.cpp content_store_room_test.cpp content_store_test.cpp device_worker_test.cpp executor_end_test.cpp
          executor_test.cpp job_test.cpp root_folder_test.cpp token_list_test.cpp upload_space_test.cpp uploads_test.cpp work_queue_test.cpp
  LINK service test_meshes PkgConfig::cairo
  LABELS gpu)
