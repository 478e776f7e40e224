# Many machines: a Slurm cluster on this one, and the manifests for Kubernetes.
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
set(farm_tests ${CMAKE_CURRENT_SOURCE_DIR}/farm)
# Sanitizers change nothing about files that are shared, but take long.
if(NOT SCENE_ANALYZER_SANITIZE)
  add_test(NAME Farm.Slurm
    COMMAND ${Python3_EXECUTABLE} ${farm_tests}/slurm_cluster.py --
            ${Python3_EXECUTABLE} ${farm_tests}/slurm_test.py $<TARGET_FILE:scene-analyzer>)
  set_tests_properties(Farm.Slurm PROPERTIES LABELS "gpu;farm" TIMEOUT 900 RUN_SERIAL TRUE SKIP_RETURN_CODE 77)
endif()
add_test(NAME Farm.SlurmClusterLeavesNothing
  COMMAND ${Python3_EXECUTABLE} ${farm_tests}/slurm_cluster_test.py ${farm_tests}/slurm_cluster.py)
set_tests_properties(Farm.SlurmClusterLeavesNothing PROPERTIES LABELS farm TIMEOUT 300 SKIP_RETURN_CODE 77)
add_test(NAME Farm.Kubernetes
  COMMAND ${Python3_EXECUTABLE} ${farm_tests}/kubernetes_test.py $<TARGET_FILE:scene-analyzer>)
set_tests_properties(Farm.Kubernetes PROPERTIES LABELS farm TIMEOUT 60)
