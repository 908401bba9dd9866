// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Stored attempts to be looked at again, by as many pages as like: what the host said of a moment
// then, said again as answers over HTTP. It touches neither the seat nor an exercise that runs.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "records/attempt.hpp"
#include "server/http_message.hpp"
#include "server/view_debrief.hpp"
#include "session/exercise_pictures.hpp"
#include "simulation/replay_player.hpp"

namespace carpus::server {

/// A stretch of a recording, and how often its state is told [ticks].
struct ReplayStretch {
  std::int64_t from = 0;
  std::int64_t to = 0;
  std::int64_t every = 0;
};

/// May be asked from several threads; states and pictures do not wait for each other.
class ReplayDesk {
 public:
  using Load = std::function<std::optional<records::Attempt>(std::int64_t id)>;
  /// States that one answer may hold, and ticks that they may be spread over: a second's work.
  static constexpr std::int64_t kMostStates = 400;
  static constexpr std::int64_t kMostTicks = 64'000;

  /// @param data, procedures  must outlive it. @param load  of the records.
  ReplayDesk(const cases::CaseData& data, const procedure::ProcedureList& procedures, Load load);
  ~ReplayDesk();

  /// `exercise`, as it was told first.
  [[nodiscard]] HttpResponse exercise(std::int64_t id);
  /// A line each: `tissue` and `snapshot` as the page was told them; of a finished assessed attempt
  /// with the truth, unless it is void.
  [[nodiscard]] HttpResponse states(std::int64_t id, const ReplayStretch& stretch);
  /// The picture that was taken in this tick, or the live one of it: the binary frame.
  [[nodiscard]] HttpResponse picture(std::int64_t id, std::int64_t tick);
  /// `picture_truth` of that picture; refused where the truth stays locked.
  [[nodiscard]] HttpResponse truth(std::int64_t id, std::int64_t tick);
  /// `view_debrief` of the attempt.
  [[nodiscard]] HttpResponse views(std::int64_t id);
  /// `seen_cartilage` of an arthroscopy.
  [[nodiscard]] HttpResponse cartilage(std::int64_t id);

 private:
  struct Recorded {
    std::shared_ptr<const simulation::Recording> recording;
    const procedure::Procedure* procedure = nullptr;
    bool tells_truth = true;
    std::vector<Tick> looks;  ///< when pictures were taken
    std::string problem;      ///< why it cannot be shown
  };
  struct Opened {
    std::int64_t id = 0;
    std::shared_ptr<const Recorded> recorded;
    std::unique_ptr<simulation::ReplayPlayer> player;
  };
  /// Worlds that stand where they were last looked at, newest first.
  struct Shelf {
    std::mutex mutex;
    std::list<Opened> opened;
  };
  /// Two attempts side by side, and two more: a world takes some 100 MB.
  static constexpr std::size_t kMostOpened = 2;
  static constexpr std::size_t kMostRecorded = 4;

  [[nodiscard]] std::shared_ptr<const Recorded> recorded_of(std::int64_t id);
  [[nodiscard]] Recorded decoded(const records::Attempt& attempt) const;
  [[nodiscard]] Opened& open(Shelf& shelf,
                             std::int64_t id,
                             const std::shared_ptr<const Recorded>& recorded) const;
  /// Why this attempt has no truth to be told; nothing where it has.
  /// What is refused where it cannot be shown. @param why  the truth stays locked
  [[nodiscard]] static std::optional<HttpResponse> closed(
      const std::shared_ptr<const Recorded>& recorded,
      const std::string& why);
  [[nodiscard]] static std::optional<HttpResponse> locked(
      const std::shared_ptr<const Recorded>& recorded);
  [[nodiscard]] ViewDebrief& debrief();
  /// @param before  state a pulse earlier. Empty: nothing was looked at.
  [[nodiscard]] std::string frame_of(const procedure::Procedure& procedure,
                                     const simulation::ReplayPlayer& player,
                                     const simulation::Snapshot& before);

  const cases::CaseData& data_;
  const procedure::ProcedureList& procedures_;
  std::string case_fingerprint_;
  Load load_;
  std::mutex recorded_mutex_;
  std::list<std::pair<std::int64_t, std::shared_ptr<const Recorded>>> recorded_;  ///< newest first
  Shelf for_states_;
  Shelf for_pictures_;
  // Under for_pictures_.mutex, made when they are first asked for.
  std::unique_ptr<session::ExercisePictures> pictures_;
  std::unique_ptr<ViewDebrief> debrief_;
};

}  // namespace carpus::server
