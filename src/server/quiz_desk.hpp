// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The view quiz in a thread of its own: screws are generated and pictures rendered there, and
// nobody waits for them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cases/case_data.hpp"
#include "protocol/messages.hpp"
#include "records/quiz_answer.hpp"
#include "server/work_thread.hpp"

namespace carpus::view_trainer {
class ViewQuiz;
}

namespace carpus::server {

using QuizWish =
    std::variant<protocol::QuizBegin, protocol::QuizNext, protocol::QuizLook, protocol::QuizAnswer>;

/// What is said to a wish: messages, then a picture's frame, either of which there may be none of.
struct QuizReply {
  std::vector<protocol::HostMessage> messages;
  std::string frame;
  /// For the records, where a question was answered; without case, time and number.
  std::optional<records::QuizAnswer> answer;
};

class QuizDesk {
 public:
  /// Called in the desk's thread.
  using Deliver = std::function<void(QuizReply reply)>;

  /// @param data  must outlive it; nothing is made of it before the first wish.
  explicit QuizDesk(const cases::CaseData& data);
  ~QuizDesk();

  /// @param player  whose questions go on; another begins anew.
  /// @return false where too much waits.
  [[nodiscard]] bool ask(const std::string& player, QuizWish wish, Deliver deliver);

 private:
  [[nodiscard]] records::QuizAnswer answered(const protocol::QuizTruth& truth);
  [[nodiscard]] QuizReply reply_to(const std::string& player, const QuizWish& wish);
  void ask_next(QuizReply& reply);
  void add_picture(const std::string& view, QuizReply& reply);

  static constexpr std::size_t kMaxWaiting = 16;

  const cases::CaseData& data_;
  std::unique_ptr<view_trainer::ViewQuiz> quiz_;  ///< the thread's own, as is the next
  std::string player_;
  protocol::QuizBegin begun_;
  std::int64_t views_told_ = 0;  ///< views that earlier questions took
  std::unique_ptr<WorkThread> thread_;
};

}  // namespace carpus::server
