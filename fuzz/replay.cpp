// replay.cpp — Runs a fuzz target over its seeds, over files, and over seeded mutations of both; or writes
// the seeds for libFuzzer.
//
//   fuzz_<target>_replay [--mutations N] [--seed N] [FOLDER...]
//   fuzz_<target>_replay --write-seeds FOLDER
//
// Ends with a signal where the target finds a broken promise; the input that did it stands in the file
// crash-input of the working folder then.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "mutate.h"
#include "target.h"

// Of the sanitizers, where they are linked.
extern "C" void __sanitizer_set_death_callback(void (*)()) __attribute__((weak));

namespace {

namespace fs = std::filesystem;

struct Request {
  std::uint64_t mutations = 0, seed = 1;
  std::vector<fs::path> folders;
  fs::path write_seeds;
};

std::uint64_t number(const char* text) {
  std::uint64_t value = 0;
  const char* const end = text + std::strlen(text);
  if (std::from_chars(text, end, value).ptr != end)
    throw std::runtime_error(std::string("no number: ") + text);
  return value;
}

Request read_request(int argc, char** argv) {
  Request request;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool option = argument.starts_with("--");
    if (option && i + 1 == argc) throw std::runtime_error(argument + " needs a value");
    if (!option)
      request.folders.emplace_back(argument);
    else if (argument == "--mutations")
      request.mutations = number(argv[++i]);
    else if (argument == "--seed")
      request.seed = number(argv[++i]);
    else if (argument == "--write-seeds")
      request.write_seeds = argv[++i];
    else
      throw std::runtime_error("unknown option " + argument);
  }
  return request;
}

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << bytes;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

// Sorted, so that every run is the same.
std::vector<std::string> read_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> inputs;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return inputs;
}

const std::string* current = nullptr;
std::string kept;  // where it goes; absolute, because targets change the working folder

// Only what a signal handler may do.
void keep_current() {
  const int file = ::open(kept.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0 || current == nullptr) return;
  constexpr char kMessage[] = "the input is in the file crash-input\n";
  if (::write(file, current->data(), current->size()) == static_cast<ssize_t>(current->size()) &&
      ::write(STDERR_FILENO, kMessage, sizeof kMessage - 1) > 0)
    ::close(file);
}

void keep_input_of_crashes() {
  kept = fs::absolute("crash-input").string();
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(keep_current);
  struct sigaction action {};
  action.sa_handler = [](int) { keep_current(); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // returns into what ends the program for good
  std::vector<int> signals = {SIGABRT};
  if (__sanitizer_set_death_callback == nullptr) signals.insert(signals.end(), {SIGSEGV, SIGBUS, SIGFPE});
  for (const int signal : signals) ::sigaction(signal, &action, nullptr);
}

void run(const std::string& input) {
  current = &input;
  // On the heap and of exactly this size: a sanitizer sees a step beyond it.
  const std::vector<std::uint8_t> bytes(input.begin(), input.end());
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

int replay(const Request& request) {
  std::vector<std::string> inputs = scene_analyzer::fuzz::seeds();
  const std::size_t seeds = inputs.size();
  for (const fs::path& folder : request.folders)
    if (fs::exists(folder))
      for (std::string& input : read_folder(folder)) inputs.push_back(std::move(input));
  for (const std::string& input : inputs) run(input);
  std::mt19937_64 random(request.seed);
  for (std::uint64_t i = 0; i < request.mutations; ++i)
    run(scene_analyzer::fuzz::mutate(inputs[random() % inputs.size()], random));
  std::printf("%zu seeds, %zu files, %llu mutations\n", seeds, inputs.size() - seeds,
              static_cast<unsigned long long>(request.mutations));
  return inputs.empty() ? 1 : 0;
}

int write_seeds(const fs::path& folder) {
  fs::create_directories(folder);
  std::size_t count = 0;
  for (const std::string& seed : scene_analyzer::fuzz::seeds()) write(folder / std::to_string(count++), seed);
  std::printf("%zu seeds in %s\n", count, folder.c_str());
  return count == 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Request request = read_request(argc, argv);
    keep_input_of_crashes();
    return request.write_seeds.empty() ? replay(request) : write_seeds(request.write_seeds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
