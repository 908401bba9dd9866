// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The view quiz at the station: whoever has the seat plays it; no exercise is touched. What is
// answered goes into the records.
#include <utility>

#include "core/hexadecimal.hpp"
#include "core/person_name.hpp"
#include "protocol/bodies.hpp"
#include "records/utc_time.hpp"
#include "server/station.hpp"

namespace carpus::server {

void Station::on_message(const protocol::QuizBegin& wish) {
  if (const auto problem = problem_of_name(wish.trainee)) {
    return refuse(*problem, "Type the name anew, then begin.");
  }
  ask_quiz(wish);
}
void Station::on_message(const protocol::QuizNext& wish) { ask_quiz(wish); }
void Station::on_message(const protocol::QuizLook& wish) { ask_quiz(wish); }
void Station::on_message(const protocol::QuizAnswer& wish) { ask_quiz(wish); }

void Station::ask_quiz(QuizWish wish) {
  if (!quiz_) quiz_ = std::make_unique<QuizDesk>(data_);
  // Held until it is answered: the reply is this page's and nobody else's.
  const std::shared_ptr<PageConnection> page = operator_;
  const bool is_asked = quiz_->ask(
      operator_word_, std::move(wish),
      [this, page, browser = page->guest().browser, network = network_](QuizReply reply) mutable {
        // From the desk's own thread: it is kept even if the page has gone or the station stops.
        if (reply.answer) store(std::move(*reply.answer), browser, network);
        if (network == nullptr) return;
        network->post([this, page, reply = std::move(reply)] {
          if (page != operator_) return;
          for (const protocol::HostMessage& message : reply.messages) send(message);
          if (!reply.frame.empty()) page->send_binary(reply.frame);
        });
      });
  if (!is_asked) refuse("The quiz has more to do than it can", "Wait for its answer.");
}

void Station::store(records::QuizAnswer answer,
                    const std::string& browser,
                    NetworkServer* network) {
  answer.case_name = data_.pseudonym;
  answer.case_fingerprint = hexadecimal(case_fingerprint_);
  answer.answered_at = records::utc_now();
  records_.save(std::move(answer), [this, browser, network, owners = over_cases_.quiz_owners](
                                       const records::KeptAttempt& kept) {
    if (kept.id > 0) owners->add(kept.id, browser);
    if (kept.problem.empty() || network == nullptr) return;
    network->post([this, problem = kept.problem] {
      log_(problem);
      refuse(problem, "Tell the person who runs this station; the quiz goes on.");
    });
  });
}

bool Station::is_quiz(const protocol::PageMessage& message) {
  return std::holds_alternative<protocol::QuizBegin>(message) ||
         std::holds_alternative<protocol::QuizNext>(message) ||
         std::holds_alternative<protocol::QuizLook>(message) ||
         std::holds_alternative<protocol::QuizAnswer>(message);
}

}  // namespace carpus::server
