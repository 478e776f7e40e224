# FFTW is the oracle, in tests only.
pkg_check_modules(fftw3 REQUIRED IMPORTED_TARGET fftw3)
test_binary(spectrum
  SOURCES cache_test.cpp failures_test.cpp fft_plan_test.cpp spectrum_test.cpp
  LINK spectrum reference test_meshes PkgConfig::fftw3
  LABELS gpu)
