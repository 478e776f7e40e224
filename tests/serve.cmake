# The service, asked by a client that shares no code with it: Python's gRPC, which Debian's own Python has.
find_program(DEBIAN_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
find_program(GRPC_PYTHON_PLUGIN grpc_python_plugin REQUIRED)
set(stubs ${CMAKE_BINARY_DIR}/service-stubs)
set(own_protos scene_analyzer/v1/analysis.proto scene_analyzer/v1/service.proto)
set(grpc_protos grpc/health/v1/health.proto grpc/reflection/v1alpha/reflection.proto)
add_custom_command(
  OUTPUT ${stubs}/made
  COMMAND ${CMAKE_COMMAND} -E make_directory ${stubs}
  COMMAND protobuf::protoc --proto_path=${CMAKE_SOURCE_DIR}/proto --proto_path=${GRPC_PROTO} --python_out=${stubs}
          --grpc_python_out=${stubs} --plugin=protoc-gen-grpc_python=${GRPC_PYTHON_PLUGIN} ${own_protos} ${grpc_protos}
  COMMAND ${CMAKE_COMMAND} -E touch ${stubs}/made
  DEPENDS ${CMAKE_SOURCE_DIR}/proto/scene_analyzer/v1/analysis.proto ${CMAKE_SOURCE_DIR}/proto/scene_analyzer/v1/service.proto
  COMMENT "Python stubs of the service"
  VERBATIM)
add_custom_target(service_stubs ALL DEPENDS ${stubs}/made)
foreach(name answers security faults limits)
  string(SUBSTRING ${name} 0 1 first)
  string(TOUPPER ${first} first)
  string(SUBSTRING ${name} 1 -1 rest)
  add_test(NAME Service.${first}${rest}
    COMMAND ${DEBIAN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/service/${name}_test.py $<TARGET_FILE:scene-analyzer> ${stubs} ${test_layers})
  set_tests_properties(Service.${first}${rest} PROPERTIES LABELS gpu TIMEOUT 900)
endforeach()
add_test(NAME Service.Page
  COMMAND ${DEBIAN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/service/docs_test.py $<TARGET_FILE:scene-analyzer> ${stubs}
          ${CMAKE_SOURCE_DIR}/docs/service.md)
set_tests_properties(Service.Page PROPERTIES LABELS gpu TIMEOUT 600)
