// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The view quiz at the station: whoever has the seat plays it; no exercise is touched.
#include <utility>

#include "protocol/bodies.hpp"
#include "server/station.hpp"

namespace carpus::server {

void Station::on_message(const protocol::QuizBegin& wish) { ask_quiz(wish); }
void Station::on_message(const protocol::QuizNext& wish) { ask_quiz(wish); }
void Station::on_message(const protocol::QuizLook& wish) { ask_quiz(wish); }
void Station::on_message(const protocol::QuizAnswer& wish) { ask_quiz(wish); }

void Station::ask_quiz(QuizWish wish) {
  if (!quiz_) quiz_ = std::make_unique<QuizDesk>(data_);
  // Held until it is answered: the reply is this page's and nobody else's.
  const std::shared_ptr<PageConnection> page = operator_;
  const bool is_asked = quiz_->ask(operator_word_, std::move(wish),
                                   [this, page, network = network_](QuizReply reply) mutable {
                                     if (network == nullptr) return;
                                     network->post([this, page, reply = std::move(reply)] {
                                       if (page != operator_) return;
                                       for (const protocol::HostMessage& message : reply.messages)
                                         send(message);
                                       if (!reply.frame.empty()) page->send_binary(reply.frame);
                                     });
                                   });
  if (!is_asked) refuse("The quiz has more to do than it can", "Wait for its answer.");
}

bool Station::is_quiz(const protocol::PageMessage& message) {
  return std::holds_alternative<protocol::QuizBegin>(message) ||
         std::holds_alternative<protocol::QuizNext>(message) ||
         std::holds_alternative<protocol::QuizLook>(message) ||
         std::holds_alternative<protocol::QuizAnswer>(message);
}

}  // namespace carpus::server
