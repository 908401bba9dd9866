// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// New cases from a page: a scan, or the labels of a case that a person has changed, comes file by
// file over HTTP (request_head.hpp), is stored and not looked at, and handed to whoever makes
// something of it. One at a time, an instructor's; what is given up leaves nothing.
//
//   POST   /api/new_case                      {"word": "…"}, which all that follows names
//   PUT    /api/new_case/file?word=W&as=dcm   a file; its name is ours, `as` says what it is
//   POST   /api/new_case/run?word=W&title=T   makes a case of them; &of=ID a version of that one
//   GET    /api/new_case                      {"may_add": …}, whether who asks may do all this
//   GET    /api/new_case?word=W               how far it is; "choosing": which series there are
//   POST   /api/new_case/run?…&series=0       makes it of the first of them
//   POST   /api/new_case/run?…&of=ID&look=1   makes no case of changed labels, only the bones that
//   they
//                                             change, to be looked at; &grow=1 lets the water in
//                                             first
//   GET    /api/new_case/made?word=W&file=F   what it made: "bones.glb", "labels.nii.gz",
//   "mended.json" DELETE /api/new_case?word=W               gives it up
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/progress.hpp"
#include "server/http_message.hpp"
#include "server/truth_gate.hpp"
#include "server/work_thread.hpp"

namespace carpus::server {

/// What becomes of what is brought.
enum class NewCasePurpose : std::uint8_t {
  Case,      ///< a case, or a new version of one
  Look,      ///< the surfaces of the bones that were changed, as they are painted
  GrownLook  ///< the same after the watershed took what was painted as markers
};

/// What a case is to be made of: a scan, or the changed labels of a case, for a new version of it.
/// To look at: the labels as they are, and if there is a second file, as they were before.
struct NewCaseTask {
  std::filesystem::path folder;  ///< with the files, and room for what is made of them
  std::vector<std::string> files;
  std::string title;         ///< may be empty; no control characters
  std::string of_case;       ///< id of the case whose labels were changed; empty: a scan
  std::string series_uid{};  ///< which of several; empty: the only one
  NewCasePurpose purpose = NewCasePurpose::Case;
};

/// One of several series that were brought, as a person tells them apart; no date, nobody's name.
struct SeriesOffer {
  std::string uid;  ///< stays on the host
  std::string description;
  int slices = 0;
  std::array<double, 3> spacing_mm{};  ///< 0 where not known
};

struct NewCaseOutcome {
  std::string id;                     ///< of the new case; empty: there is none
  std::string problem;                ///< why there is neither, and what to do
  std::vector<SeriesOffer> series{};  ///< of which a person must choose one; else empty
  /// Of a look: the folder, within the task's, whose files are given out until it is given up.
  std::filesystem::path made{};
};

struct NewCaseOptions {
  /// Runs in a thread of its own, ends soon after `stop` is set.
  std::function<NewCaseOutcome(const NewCaseTask&, const Progress&, const std::atomic<bool>& stop)>
      make;
  std::filesystem::path incoming;  ///< a folder of ours; emptied at the start
  std::shared_ptr<const TruthGate> truth = std::make_shared<TruthGate>();
  std::uint64_t most_bytes = std::uint64_t{2} << 30U;  ///< of all files of one
  std::size_t most_files = 5000;
  std::uint64_t least_free_bytes = std::uint64_t{1} << 30U;  ///< that stay free on the disk
  std::chrono::milliseconds lapse{30000};  ///< without a word from its page: given up
};

class NewCaseDesk {
 public:
  /// @throws IoError  the folder cannot be made or emptied.
  explicit NewCaseDesk(NewCaseOptions options);
  ~NewCaseDesk();
  NewCaseDesk(const NewCaseDesk&) = delete;
  NewCaseDesk& operator=(const NewCaseDesk&) = delete;

  /// Whether a request is for this desk.
  [[nodiscard]] static bool is_for(const HttpRequest& request);
  /// Of an instructor, from our own page where it changes anything: the door sees to that. Reads
  /// the disk: not for the network's thread.
  [[nodiscard]] HttpResponse answer(const HttpRequest& request);
  [[nodiscard]] std::variant<std::unique_ptr<BodyTaker>, HttpResponse> take_body(
      const HttpRequest& request,
      std::uint64_t bytes);
  /// Now and then: gives up what no page asks after any more. Does not wait.
  void tend();

 private:
  class FileTaker;
  enum class Stage : std::uint8_t { Idle, Receiving, Working, Choosing, Done };

  [[nodiscard]] HttpResponse begin();
  [[nodiscard]] HttpResponse run(const HttpRequest& request);
  [[nodiscard]] HttpResponse run_chosen(const HttpRequest& request);
  [[nodiscard]] HttpResponse start(const NewCaseTask& task);
  [[nodiscard]] HttpResponse give_out(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse tell() const;
  [[nodiscard]] bool is_current(const HttpRequest& request) const;
  void give_up();
  void throw_away();
  /// Of a file that did not come as a whole; of what came before it nothing can be made.
  void lose(const std::string& word, const std::filesystem::path& folder);
  void remove_later(const std::filesystem::path& folder);
  void work(const NewCaseTask& task);

  NewCaseOptions options_;
  mutable std::mutex mutex_;
  Stage stage_ = Stage::Idle;
  std::string word_;
  std::filesystem::path folder_;
  std::vector<std::string> files_;
  std::uint64_t bytes_ = 0;  ///< that have come or are promised
  bool has_taker_ = false;
  std::chrono::steady_clock::time_point heard_;
  std::string doing_;
  double fraction_ = 0;
  NewCaseTask task_;
  NewCaseOutcome outcome_;
  std::atomic<bool> stop_{false};
  WorkThread chores_{64};  ///< removes
  WorkThread worker_{1};   ///< makes; last: it uses all of the above
};

}  // namespace carpus::server
