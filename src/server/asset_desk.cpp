// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/asset_desk.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/person_name.hpp"
#include "protocol/bodies.hpp"
#include "records/utc_time.hpp"
#include "server/query_number.hpp"
#include "server/request_head.hpp"

namespace carpus::server {

namespace {

HttpResponse no_such_attempt() { return make_problem(404, "There is no such attempt."); }

/// The attempt that is asked about; nothing where the target names none.
std::optional<std::int64_t> attempt_of(const HttpRequest& request) {
  const auto number = number_in_query(request.target, "attempt");
  if (!number || *number <= 0) return std::nullopt;
  return number;
}

/// Why an attempt cannot be rated; nothing where it can.
std::optional<std::string> problem_of(const records::Attempt& attempt) {
  const auto score = protocol::parse_stored_score(attempt.score_json);
  if (attempt.summary.outcome != records::Outcome::Finished || !score) {
    return "This attempt was not finished; there is nothing to rate.";
  }
  if (score->is_void.value_or(false)) return "This attempt is void; there is nothing to rate.";
  const bool looks_into_joints =
      std::any_of(score->items.begin(), score->items.end(), [](const protocol::ScoreItem& item) {
        return item.id == "cartilage_seen_share" || item.id == "brought_out_share";
      });
  if (!looks_into_joints) return "Only an arthroscopy is rated by this form.";
  return std::nullopt;
}

/// Why this is no rater's name; nothing where it is. Two that look alike would be two raters.
std::optional<std::string> problem_of_rater(const std::string& name) {
  if (name.find_first_not_of(" \t\n") == std::string::npos) {
    return "Say who rates: forms are told apart by their raters' names.";
  }
  if (name.front() == ' ' || name.back() == ' ') {
    return "The name begins or ends with a blank; remove it.";
  }
  return problem_of_name(name);
}

std::vector<arthroscopy::AssetChoice> choices_of(const std::vector<protocol::AssetAnswer>& from) {
  std::vector<arthroscopy::AssetChoice> choices;
  choices.reserve(from.size());
  for (const protocol::AssetAnswer& answer : from) {
    choices.push_back({answer.domain, static_cast<int>(answer.points)});
  }
  return choices;
}

protocol::AssetForm message_of(const records::AssetForm& form) {
  protocol::AssetForm message;
  message.rater = form.rater;
  message.saved_at = form.saved_at;
  message.revision = form.revision;
  if (const auto answers = protocol::parse_stored_asset_answers(form.answers_json)) {
    message.answers = *answers;
  }
  message.comment = form.comment;
  message.total = form.total;
  message.passes = form.passes;
  return message;
}

}  // namespace

/// Keeps what comes until it is whole.
class AssetDesk::FormTaker final : public BodyTaker {
 public:
  FormTaker(const AssetDesk& desk, Guest guest, std::int64_t attempt)
      : desk_(desk), guest_(std::move(guest)), attempt_(attempt) {}

  HttpResponse take(std::string_view piece) override {
    if (text_.size() + piece.size() > kMostBytes) return make_problem(413, "The form is too long.");
    text_ += piece;
    return make_response(kGoOn, "", "");
  }
  HttpResponse finish() override { return desk_.rate(guest_, attempt_, text_); }

 private:
  const AssetDesk& desk_;
  Guest guest_;
  std::int64_t attempt_;
  std::string text_;
};

bool AssetDesk::is_for(const HttpRequest& request) {
  const std::string_view target = request.target;
  return target.substr(0, target.find('?')) == kAssetPath;
}

HttpResponse AssetDesk::answer(const HttpRequest& request) const {
  const auto attempt = attempt_of(request);
  if (!attempt) return make_problem(400, "'attempt' is the number of an attempt.");
  const bool may_see =
      request.guest.role == Role::Instructor || owners_.is_of(*attempt, request.guest.browser);
  if (!may_see) return no_such_attempt();
  return forms_of(request.guest, *attempt);
}

std::variant<std::unique_ptr<BodyTaker>, HttpResponse> AssetDesk::take_body(
    const HttpRequest& request,
    std::uint64_t bytes) const {
  if (request.guest.role != Role::Instructor) {
    return make_problem(403, "Only who came by an instructor's link may rate an attempt.");
  }
  const auto attempt = attempt_of(request);
  if (!attempt) return make_problem(400, "'attempt' is the number of an attempt.");
  if (bytes > kMostBytes) return make_problem(413, "The form is too long.");
  return std::make_unique<FormTaker>(*this, request.guest, *attempt);
}

HttpResponse AssetDesk::rate(const Guest& guest, std::int64_t number, std::string_view text) const {
  const auto rating = protocol::parse_asset_rating(text);
  if (!rating) return make_problem(400, "The form cannot be read: " + rating.error() + ".");
  if (const auto problem = problem_of_rater(rating->rater)) return make_problem(400, *problem);
  const auto choices = choices_of(rating->answers);
  if (const auto problem = table_.problem_of(choices)) return make_problem(400, *problem);
  try {
    const auto attempt = records_.find(number);
    if (!attempt) return no_such_attempt();
    if (const auto problem = problem_of(*attempt)) return make_problem(409, *problem);
    records::AssetForm form;
    form.attempt = number;
    form.rater = rating->rater;
    form.saved_at = records::utc_now();
    form.answers_json = protocol::serialize_stored_asset_answers(rating->answers);
    form.comment = rating->comment;
    if (const auto result = table_.result_of(choices)) {
      form.total = result->total;
      form.passes = result->passes;
    }
    switch (records_.save(form, rating->revision)) {
      case records::AssetSaving::Saved:
        return forms_of(guest, number);
      case records::AssetSaving::NoAttempt:
        return no_such_attempt();
      case records::AssetSaving::Full:
        return make_problem(409, "So many have rated this attempt that no more is taken.");
      case records::AssetSaving::Stale:
        break;
    }
    return make_problem(409,
                        "A form of this name was saved here that you have not seen. Open it, or "
                        "rate under another name.");
  } catch (const IoError& error) {
    // Of the records it says already that the form was not stored, why, and what to do about it.
    return make_problem(
        503, std::string(error.what()) + ". It is still on this page: save it again afterwards.");
  }
}

HttpResponse AssetDesk::forms_of(const Guest& guest, std::int64_t attempt) const {
  protocol::AssetForms message;
  message.attempt = attempt;
  message.may_rate = guest.role == Role::Instructor;
  for (const records::AssetForm& form : records_.asset_forms(attempt)) {
    if (message.may_rate || form.total) message.forms.push_back(message_of(form));
  }
  return make_json(serialize(message));
}

}  // namespace carpus::server
