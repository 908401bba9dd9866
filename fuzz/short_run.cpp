// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs a fuzz target where there is no libFuzzer (g++): all files of the corpus, then changes of
// them, always the same. It does not learn from the code's coverage as libFuzzer does; it keeps
// ./test from missing what is plainly broken.
//
//   X_fuzz [-runs=N] [-max_len=BYTES] [-dict=FILE] CORPUS    or a file, to see it alone
//
// What fails is left in the file X_fuzz.failed of the working folder.
#include <sanitizer/common_interface_defs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/rng.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using carpus::Rng;

struct Options {
  std::size_t runs = 10'000;
  std::size_t longest = 4096;
  std::vector<std::string> words;
  std::vector<std::string> corpus;
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The quoted words of a libFuzzer dictionary.
std::vector<std::string> words_of(const fs::path& file) {
  std::vector<std::string> words;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find('"');
    const std::size_t end = line.rfind('"');
    if (line.starts_with('#') || begin == std::string::npos || end <= begin) continue;
    std::string word;
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (line[i] != '\\') {
        word += line[i];
      } else if (i + 3 < end && line[i + 1] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
        i += 3;
      } else {
        word += line[++i];
      }
    }
    words.push_back(word);
  }
  return words;
}

void add_corpus(const fs::path& place, std::vector<std::string>& corpus) {
  std::vector<fs::path> files;
  if (fs::is_directory(place)) {
    for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
  } else {
    files.push_back(place);
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) corpus.push_back(bytes_of(file));
}

void change(std::string& bytes, const Options& options, Rng& rng) {
  const std::size_t at = rng.below(bytes.size() + 1);
  const std::size_t length = std::min<std::size_t>(1 + rng.below(24), bytes.size() - at);
  constexpr std::array<char, 8> kEdges{'\0', '\1', '\x7F', '\x80', '\xFF', '9', '-', '\n'};
  switch (rng.below(8)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.below(8)));
      break;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(rng.below(256));
      break;
    case 2:
      for (std::size_t i = at; i < at + length; ++i) bytes[i] = kEdges[rng.below(kEdges.size())];
      break;
    case 3:
      bytes.resize(at);
      break;
    case 4:
      bytes.erase(at, length);
      break;
    case 5:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 6: {
      const std::string& other = options.corpus[rng.below(options.corpus.size())];
      const std::size_t from = rng.below(other.size() + 1);
      bytes.insert(at, other.substr(from, 1 + rng.below(64)));
      break;
    }
    default:
      if (options.words.empty()) break;
      bytes.replace(at, rng.below(2) == 0 ? 0 : length,
                    options.words[rng.below(options.words.size())]);
  }
  if (bytes.size() > options.longest) bytes.resize(options.longest);
}

std::string running;
std::string left_in;

/// Called where the target or a sanitizer gives up: keeps what it was given.
void keep_what_failed() {
  std::ofstream(left_in, std::ios::binary) << running;
  std::fprintf(stderr, "what failed is in %s (%zu bytes)\n", left_in.c_str(), running.size());
}

void run(const std::string& bytes) {
  running = bytes;
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  left_in = fs::path(argv[0]).filename().string() + ".failed";
  // The address sanitizer is told by ./test to take an abort for a finding.
  __sanitizer_set_death_callback(&keep_what_failed);
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::string value = argument.substr(argument.find('=') + 1);
    if (argument.starts_with("-runs=")) {
      options.runs = std::stoul(value);
    } else if (argument.starts_with("-max_len=")) {
      options.longest = std::stoul(value);
    } else if (argument.starts_with("-dict=")) {
      options.words = words_of(value);
    } else {
      add_corpus(argument, options.corpus);
    }
  }
  if (options.corpus.empty()) options.corpus.emplace_back();
  for (const std::string& seed : options.corpus) run(seed);
  if (carpus::fuzz::accepted == 0) {
    std::fprintf(stderr, "no seed is accepted: see fuzz/README.md\n");
    return 1;
  }
  Rng rng(1);
  const bool is_one_file = argc == 2 && fs::is_regular_file(argv[1]);
  for (std::size_t i = 0; i < options.runs && !is_one_file; ++i) {
    std::string bytes = options.corpus[i % options.corpus.size()];
    for (std::size_t changes = 1 + rng.below(5); changes > 0; --changes)
      change(bytes, options, rng);
    run(bytes);
  }
  std::printf("%zu seeds and %zu changes of them\n", options.corpus.size(),
              is_one_file ? 0 : options.runs);
  return 0;
}
