#include "cli/check_outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <random>

#include "cli/terminal.h"
#include "report/report.h"

namespace scene_analyzer::cli {
namespace {

// GitHub's runner looks for commands in everything that is printed, and names of assets and meshes are
// whatever a pull request says. Between these lines it looks for the word alone, which nobody can guess.
std::string without_commands(const std::string& text) {
  std::random_device random;
  const std::string word = fmt::format("scene-analyzer-{:08x}{:08x}", random(), random());
  return fmt::format("::stop-commands::{0}\n{1}::{0}::\n", word, text);
}

std::string printed(const CheckRequest& request, const gate::CheckReport& report) {
  const report::TableStyle style{.color = false, .width = terminal_width(STDOUT_FILENO), .max_rows = 0};
  const std::string table = gate::check_table(report, style);
  return request.github ? without_commands(table) + gate::github_annotations(report) : table;
}

}  // namespace

void write_check(const CheckRequest& request, const gate::CheckReport& report, Outputs& outputs) {
  if (request.json) outputs.attempt([&] { report::write_file(*request.json, gate::check_json(report)); });
  if (request.junit) outputs.attempt([&] { report::write_file(*request.junit, gate::check_junit(report)); });
  if (request.sarif) outputs.attempt([&] { report::write_file(*request.sarif, gate::check_sarif(report)); });
  if (request.table()) outputs.attempt([&] { report::write_file("-", printed(request, report)); });
}

}  // namespace scene_analyzer::cli
