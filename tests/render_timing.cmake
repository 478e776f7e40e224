test_binary(render_timing
  SOURCES estimate_test.cpp framing_test.cpp render_timer_test.cpp
  LINK render_timing test_meshes
  LABELS gpu)
