// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/pathology_desk.hpp"

#include <utility>

#include "arthroscopy/named_grades.hpp"
#include "core/error.hpp"
#include "core/result.hpp"
#include "server/query_text.hpp"
#include "server/request_head.hpp"
#include "session/descriptions.hpp"

namespace carpus::server {

namespace {

using arthroscopy::PathologyTable;
using protocol::PathologyOrigin;

protocol::PreparedPathology message_of(const std::optional<cases::PreparedPathology>& pathology) {
  protocol::PreparedPathology message;
  message.origin = PathologyOrigin::Random;
  if (!pathology) return message;
  message.origin = pathology->is_drawn ? PathologyOrigin::Seed : PathologyOrigin::Chosen;
  message.seed = static_cast<std::int64_t>(pathology->seed);
  for (const auto& [finding, grade] :
       arthroscopy::named_grades(pathology->grades, PathologyTable::generic())) {
    message.grades.push_back({finding, grade});
  }
  return message;
}

using Wished = std::optional<cases::PreparedPathology>;

Result<Wished> pathology_of(const protocol::PathologyWish& wish) {
  const PathologyTable& table = PathologyTable::generic();
  const auto seed = static_cast<std::uint64_t>(wish.seed.value_or(0));
  switch (wish.origin) {
    case PathologyOrigin::Random:
      return Wished{};
    case PathologyOrigin::Seed:
      if (!wish.seed) return Refusal{"a pathology by a seed needs the seed"};
      return Wished{arthroscopy::drawn_pathology(seed, table)};
    case PathologyOrigin::Chosen:
      break;
  }
  cases::PreparedPathology chosen;
  chosen.seed = seed;
  for (const protocol::PreparedGrade& each : wish.grades) {
    const auto set = set_grade(chosen.grades, table, each.finding, each.grade);
    if (!set) return Refusal{set.error()};
  }
  return Wished{chosen};
}

}  // namespace

/// Keeps what comes until it is whole.
class PathologyDesk::WishTaker final : public BodyTaker {
 public:
  WishTaker(const PathologyDesk& desk, std::string target)
      : desk_(desk), target_(std::move(target)) {}

  HttpResponse take(std::string_view piece) override {
    if (text_.size() + piece.size() > kMostBytes) return make_problem(413, "That is too long.");
    text_ += piece;
    return make_response(kGoOn, "", "");
  }
  HttpResponse finish() override { return desk_.prepare(target_, text_); }

 private:
  const PathologyDesk& desk_;
  std::string target_;
  std::string text_;
};

PathologyDesk::PathologyDesk(std::shared_ptr<const SharedShelf> shelf,
                             std::shared_ptr<const TruthGate> truth,
                             PathologyFiles files)
    : shelf_(std::move(shelf)), truth_(std::move(truth)), files_(std::move(files)) {}

bool PathologyDesk::is_for(const HttpRequest& request) {
  const std::string_view target = request.target;
  return target.substr(0, target.find('?')) == kPathologyPath;
}

std::filesystem::path PathologyDesk::folder_of(const std::string& target) const {
  const auto id = text_in_query(target, "case");
  const auto shelf = shelf_->now();
  const ShelvedCase* found = id ? shelf->find(*id) : nullptr;
  return found != nullptr ? found->folder : std::filesystem::path();
}

std::optional<HttpResponse> PathologyDesk::refused(const HttpRequest& request) const {
  if (request.guest.role != Role::Instructor) {
    return make_problem(403, "Only who came by an instructor's link may prepare a case.");
  }
  if (truth_->is_closed()) {
    return make_problem(409,
                        "An assessed operation is under way here; prepare cases when it has "
                        "ended.");
  }
  if (folder_of(request.target).empty()) return make_problem(404, "There is no such case.");
  return std::nullopt;
}

HttpResponse PathologyDesk::answer(const HttpRequest& request) const {
  if (request.target == kPathologyPath) {
    protocol::CasePathology message;
    message.may_prepare = request.guest.role == Role::Instructor;
    return make_json(serialize(message));
  }
  if (auto problem = refused(request)) return *problem;
  return tell(request.target);
}

HttpResponse PathologyDesk::tell(const std::string& target) const {
  protocol::CasePathology message;
  message.may_prepare = true;
  message.findings = session::findings_of(PathologyTable::generic());
  try {
    message.prepared = message_of(files_.read(folder_of(target)));
  } catch (const Error& error) {
    return make_problem(
        409, std::string(error.what()) + "; `carpus pathology CASE --clear` removes it.");
  }
  return make_json(serialize(message));
}

std::variant<std::unique_ptr<BodyTaker>, HttpResponse> PathologyDesk::take_body(
    const HttpRequest& request,
    std::uint64_t bytes) const {
  if (auto problem = refused(request)) return *problem;
  if (bytes > kMostBytes) return make_problem(413, "That is too long.");
  return std::make_unique<WishTaker>(*this, request.target);
}

HttpResponse PathologyDesk::prepare(const std::string& target, std::string_view text) const {
  const auto wish = protocol::parse_pathology_wish(text);
  if (!wish) return make_problem(400, "The pathology cannot be read: " + wish.error() + ".");
  const auto wished = pathology_of(*wish);
  if (!wished) return make_problem(400, "The pathology cannot be taken: " + wished.error() + ".");
  try {
    files_.write(folder_of(target), *wished);
  } catch (const Error& error) {
    return make_problem(503, std::string(error.what()) + ". Nothing was changed.");
  }
  return tell(target);
}

}  // namespace carpus::server
