// mutate.h — Changes files the way damage and malice do: bits, bytes, lengths, numbers in text, pieces moved.
#pragma once

#include <random>
#include <string>

namespace scene_analyzer::fuzz {

// One to four changes. The same generator state gives the same bytes. The result is at most twice as long as
// `original`, and 64 bytes.
std::string mutate(const std::string& original, std::mt19937_64& random);

}  // namespace scene_analyzer::fuzz
