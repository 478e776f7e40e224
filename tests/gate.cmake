test_binary(gate
  SOURCES gate_fixture.cpp baseline_test.cpp budget_test.cpp evaluate_test.cpp init_budget_test.cpp outputs_test.cpp quantity_test.cpp
  LINK gate fmt::fmt nlohmann_json::nlohmann_json)
