// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/quiz_desk.hpp"

#include <exception>
#include <utility>

#include "server/picture_worker.hpp"
#include "view_trainer/view_quiz.hpp"

namespace carpus::server {
namespace {

protocol::HostMessage refusal(std::string reason) {
  return protocol::Error{std::move(reason),
                         "Begin the quiz anew, or go on with its next question."};
}

}  // namespace

QuizDesk::QuizDesk(const cases::CaseData& data)
    : data_(data), thread_(std::make_unique<WorkThread>(kMaxWaiting)) {}

QuizDesk::~QuizDesk() { thread_.reset(); }

bool QuizDesk::ask(const std::string& player, QuizWish wish, Deliver deliver) {
  return thread_->post([this, player, wish = std::move(wish), deliver = std::move(deliver)] {
    QuizReply reply;
    try {
      reply = reply_to(player, wish);
    } catch (const std::exception& error) {
      reply.messages.push_back(refusal(error.what()));
    }
    deliver(std::move(reply));
  });
}

QuizReply QuizDesk::reply_to(const std::string& player, const QuizWish& wish) {
  QuizReply reply;
  if (!quiz_) quiz_ = std::make_unique<view_trainer::ViewQuiz>(data_);
  if (const auto* begin = std::get_if<protocol::QuizBegin>(&wish)) {
    player_ = player;
    begun_ = *begin;
    views_told_ = 0;
    quiz_->begin(static_cast<std::uint64_t>(begin->seed));
    ask_next(reply);
  } else if (player != player_) {
    reply.messages.push_back(refusal("Another page's quiz was asked last"));
  } else if (std::holds_alternative<protocol::QuizNext>(wish)) {
    ask_next(reply);
  } else if (const auto* look = std::get_if<protocol::QuizLook>(&wish)) {
    add_picture(look->view, reply);
  } else if (const auto* answer = std::get_if<protocol::QuizAnswer>(&wish)) {
    auto truth = quiz_->answer(*answer);
    if (truth) reply.answer = answered(*truth);
    reply.messages.push_back(truth ? protocol::HostMessage(std::move(truth.value()))
                                   : refusal(truth.error()));
  }
  return reply;
}

records::QuizAnswer QuizDesk::answered(const protocol::QuizTruth& truth) {
  records::QuizAnswer answer;
  answer.trainee = begun_.trainee;
  answer.seed = begun_.seed;
  answer.question = truth.number;
  answer.place = name_of(truth.place);
  answer.depth_mm = truth.depth_mm;
  answer.answered = name_of(truth.answered);
  answer.next_view = truth.next_view;
  answer.is_view_right = truth.is_view_right;
  answer.views_taken = truth.tally.views_taken - views_told_;
  views_told_ = truth.tally.views_taken;
  return answer;
}

void QuizDesk::ask_next(QuizReply& reply) {
  auto question = quiz_->next();
  if (!question) return reply.messages.push_back(refusal(question.error()));
  const std::string first = question->first_view;
  reply.messages.emplace_back(std::move(question.value()));
  add_picture(first, reply);
}

void QuizDesk::add_picture(const std::string& view, QuizReply& reply) {
  const auto picture = quiz_->look(view);
  if (!picture) return reply.messages.push_back(refusal(picture.error()));
  TakenShot shot;
  shot.kind = PictureKind::Quiz;
  shot.number = static_cast<std::uint32_t>(picture->question);
  shot.rotation_deg = picture->angles.rotation_deg;
  shot.tilt_deg = picture->angles.tilt_deg;
  reply.frame = encode_picture(shot, picture->image);
}

}  // namespace carpus::server
