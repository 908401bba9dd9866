// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/new_case_maker.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <utility>

#include "case_io/case_cover.hpp"
#include "cli/find_cases.hpp"
#include "cli/series_choice.hpp"
#include "cli/watched_program.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using server::NewCaseOutcome;
using server::NewCaseTask;

constexpr std::chrono::minutes kLongest{20};
constexpr std::chrono::seconds kLongestLook{60};
constexpr std::size_t kLongestStem = 40;

constexpr const char* kSeriesFile = "series.json";
constexpr std::size_t kLargestSeriesFile = 1U << 20U;

bool is_slice(const std::string& file) { return file.ends_with(".dcm"); }

/// One series is a folder of slices; a volume is one file.
std::string scan_in(const NewCaseTask& task) {
  const auto slices =
      static_cast<std::size_t>(std::count_if(task.files.begin(), task.files.end(), is_slice));
  if (slices == task.files.size()) return task.folder;
  return task.files.size() == 1 ? (task.folder / task.files.front()).string() : std::string();
}

/// Where it stands on this machine is nobody's business on a page.
std::string without_place(std::string text, const fs::path& place) {
  const std::string name = place.string();
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
    text.replace(at, name.size(), "the scan");
  }
  if (text.starts_with("carpus: ")) text.erase(0, 8);
  return text;
}

std::vector<server::SeriesOffer> series_to_choose(const fs::path& folder) {
  std::error_code none;
  const auto bytes = fs::file_size(folder / kSeriesFile, none);
  if (none || bytes > kLargestSeriesFile) return {};
  std::ifstream file(folder / kSeriesFile, std::ios::binary);
  return parse_series_choice(std::string(std::istreambuf_iterator<char>(file), {}));
}

std::string title_of_version(const server::ShelvedCase& of, const std::string& id) {
  const std::string own = case_io::read_pseudonym(of.folder).value_or(of.id);
  const std::size_t before = own.rfind(", version ");
  return own.substr(0, std::min<std::size_t>(before, 90)) + ", version " +
         id.substr(id.rfind('-') + 1);
}

}  // namespace

std::string free_id(const std::string& from,
                    const server::CaseShelf& shelf,
                    const fs::path& folder) {
  std::string stem;
  for (const char c : from.substr(0, kLongestStem)) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain || (!stem.empty() && stem.back() != '-')) stem += is_plain ? c : '-';
  }
  // A version of "demo-2" is "demo-3".
  const std::size_t hyphen = stem.find_last_not_of("0123456789-");
  stem = hyphen == std::string::npos ? "scan" : stem.substr(0, hyphen + 1);
  for (int number = 2;; ++number) {
    const std::string id = stem + "-" + std::to_string(number);
    if (shelf.find(id) == nullptr && !fs::exists(folder / id)) return id;
  }
}

NewCaseMaker::NewCaseMaker(fs::path program,
                           fs::path cases,
                           std::shared_ptr<server::SharedShelf> shelf)
    : program_(std::move(program)), cases_(std::move(cases)), shelf_(std::move(shelf)) {}

NewCaseOutcome NewCaseMaker::make(const NewCaseTask& task,
                                  const Progress& progress,
                                  const std::atomic<bool>& stop) const {
  const auto shelf = shelf_->now();
  const server::ShelvedCase* of = shelf->find(task.of_case);
  if (!task.of_case.empty() && (of == nullptr || of->folder.empty())) {
    return {{}, "There is no such case on this station."};
  }
  if (task.purpose != server::NewCasePurpose::Case) {
    if (of == nullptr) return {{}, "It does not say whose labels they are."};
    return look(task, *of, progress, stop);
  }
  const fs::path made = task.folder / "case";
  std::vector<std::string> words;
  if (of == nullptr) {
    const std::string scan = scan_in(task);
    if (scan.empty()) {
      return {{}, "Bring the slices of one DICOM series, or one volume file, and nothing else."};
    }
    words = {"reconstruct",   scan,
             "--pseudonym",   task.title.empty() ? "new scan" : task.title,
             "--list-series", task.folder / kSeriesFile};
    if (!task.series_uid.empty()) words.insert(words.end(), {"--series", task.series_uid});
  } else {
    const std::string id = free_id(of->id, *shelf, cases_);
    words = {"reconstruct", of->folder,
             "--labels",    task.folder / task.files.front(),
             "--pseudonym", task.title.empty() ? title_of_version(*of, id) : task.title};
  }
  words.insert(words.end(), {"--out", made});
  const ProgramEnd end = run_watched(program_, words, progress, stop, kLongest);
  if (end.was_stopped) return {{}, "It took too long and was ended."};
  if (!end.is_well) {
    NewCaseOutcome outcome{{}, without_place(end.complaint, task.folder)};
    if (task.series_uid.empty()) outcome.series = series_to_choose(task.folder);
    return outcome;
  }
  return put_on_shelf(task, made);
}

NewCaseOutcome NewCaseMaker::look(const NewCaseTask& task,
                                  const server::ShelvedCase& of,
                                  const Progress& progress,
                                  const std::atomic<bool>& stop) const {
  const fs::path made = task.folder / "mended";
  std::vector<std::string> words{"mend",  of.folder, "--labels", task.folder / task.files.front(),
                                 "--out", made};
  if (task.files.size() > 1) words.insert(words.end(), {"--before", task.folder / task.files[1]});
  if (task.purpose == server::NewCasePurpose::GrownLook) words.emplace_back("--grow");
  const ProgramEnd end = run_watched(program_, words, progress, stop, kLongestLook);
  if (end.was_stopped) return {{}, "It took too long and was ended."};
  if (!end.is_well) return {{}, without_place(end.complaint, task.folder)};
  NewCaseOutcome outcome;
  outcome.made = made;
  return outcome;
}

NewCaseOutcome NewCaseMaker::put_on_shelf(const NewCaseTask& task, const fs::path& made) const {
  NewCaseOutcome outcome;
  shelf_->change([&](server::CaseShelf& shelf) {
    if (shelf.cases.size() >= kMostCases) {
      outcome.problem = "There is no room for another case; take some away and start anew.";
      return;
    }
    outcome.id = free_id(task.of_case.empty() ? "scan" : task.of_case, shelf, cases_);
    std::error_code error;
    fs::rename(made, cases_ / outcome.id, error);
    if (error) {
      outcome = {{}, "The case cannot be kept: " + error.message() + "."};
      return;
    }
    shelf.cases.push_back(shelved_case(cases_ / outcome.id));
  });
  return outcome;
}

}  // namespace carpus::cli
