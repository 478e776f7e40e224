#include "cli/run_program.h"

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

void redirect(const std::filesystem::path& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

[[noreturn]] void become_program(const std::vector<std::string>& arguments, const ProgramOptions& options) {
  setenv("XDG_CACHE_HOME", SCENE_ANALYZER_TEST_CACHE, 1);
  for (const auto& [name, value] : options.environment)
    value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
  std::vector<char*> argv = {const_cast<char*>("scene-analyzer")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(SCENE_ANALYZER_BINARY, argv.data());
  _exit(127);
}

std::string read_all(int descriptor) {
  std::string text;
  char buffer[4096];
  // A pseudo terminal ends with an error (EIO) when the program closes it.
  for (ssize_t count = 0; (count = read(descriptor, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  return text;
}

int exit_code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::vector<std::string> without_timing(std::vector<std::string> arguments) {
  const auto has = [&](const char* option) {
    return std::ranges::any_of(arguments, [&](const std::string& one) { return one.starts_with(option); });
  };
  if (!arguments.empty() && arguments.front() == "analyze" && !has("--metrics") && !has("--timing-budget"))
    arguments.insert(arguments.begin() + 1, {"--metrics", kUntimedMetrics});
  return arguments;
}

}  // namespace

struct RunningProgram::Capture {
  TemporaryFolder folder;
  std::filesystem::path out = folder.path() / "out", err = folder.path() / "err";
};

RunningProgram::RunningProgram(const std::vector<std::string>& given, const ProgramOptions& options)
    : capture_(std::make_unique<Capture>()) {
  const std::vector<std::string> arguments = without_timing(given);
  std::filesystem::create_directories(SCENE_ANALYZER_TEST_CACHE);
  winsize size{};
  size.ws_col = 80;
  size.ws_row = 25;
  child_ = options.terminal ? forkpty(&terminal_, nullptr, nullptr, &size) : fork();
  if (child_ < 0) throw std::runtime_error("fork failed");
  if (child_ > 0) return;
  if (!options.terminal) redirect(capture_->out, STDOUT_FILENO);
  redirect(capture_->err, STDERR_FILENO);
  become_program(arguments, options);
}

RunningProgram::~RunningProgram() {
  if (!has_ended()) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  if (terminal_ >= 0) ::close(terminal_);
}

bool RunningProgram::has_ended() {
  int status = 0;
  if (exit_code_ < 0 && ::waitpid(child_, &status, WNOHANG) == child_) exit_code_ = exit_code_of(status);
  return exit_code_ >= 0;
}

void RunningProgram::send(int signal) const {
  if (exit_code_ < 0) ::kill(child_, signal);
}

std::string RunningProgram::err() const {
  return TemporaryFolder::read(capture_->err);
}

ProgramResult RunningProgram::wait() {
  ProgramResult result;
  if (terminal_ >= 0) result.out = read_all(terminal_);
  int status = 0;
  if (exit_code_ < 0) {
    if (::waitpid(child_, &status, 0) != child_) throw std::runtime_error("waitpid failed");
    exit_code_ = exit_code_of(status);
  }
  result.exit_code = exit_code_;
  if (terminal_ < 0) result.out = TemporaryFolder::read(capture_->out);
  result.err = err();
  return result;
}

ProgramResult run_program(const std::vector<std::string>& arguments, const ProgramOptions& options) {
  return RunningProgram(arguments, options).wait();
}

std::vector<std::string> lines_with(const std::string& text, const std::string& start) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(start)) lines.push_back(line);
  return lines;
}

std::vector<std::string> complaints(const ProgramResult& result) {
  std::vector<std::string> lines = lines_with(result.err, "");
  std::erase_if(lines, [](const std::string& line) { return line.starts_with("progress: "); });
  return lines;
}

}  // namespace scene_analyzer
