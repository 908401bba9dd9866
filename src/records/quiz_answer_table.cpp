// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/detail/quiz_answer_table.hpp"

#include <SQLiteCpp/Statement.h>

#include <limits>
#include <utility>

namespace carpus::records::detail {

std::int64_t insert(SQLite::Database& database, const QuizAnswer& answer) {
  SQLite::Statement insert(
      database,
      "INSERT INTO quiz_answer (trainee, case_name, case_fingerprint, seed, question, answered_at, "
      "place, depth_mm, answered, next_view, is_view_right, views_taken) VALUES (:trainee, "
      ":case_name, :case_fingerprint, :seed, :question, :answered_at, :place, :depth_mm, "
      ":answered, :next_view, :is_view_right, :views_taken)");
  insert.bind(":trainee", answer.trainee);
  insert.bind(":case_name", answer.case_name);
  insert.bind(":case_fingerprint", answer.case_fingerprint);
  insert.bind(":seed", answer.seed);
  insert.bind(":question", answer.question);
  insert.bind(":answered_at", answer.answered_at);
  insert.bind(":place", answer.place);
  insert.bind(":depth_mm", answer.depth_mm);
  insert.bind(":answered", answer.answered);
  insert.bind(":next_view", answer.next_view);
  insert.bind(":is_view_right", answer.is_view_right ? 1 : 0);
  insert.bind(":views_taken", answer.views_taken);
  insert.exec();
  return database.getLastInsertRowid();
}

QuizAnswerPage read_page(const SQLite::Database& database,
                         std::int64_t before,
                         std::size_t most,
                         const std::function<bool(std::int64_t id)>& seen) {
  QuizAnswerPage page;
  SQLite::Statement rows(database, "SELECT * FROM quiz_answer WHERE id < ? ORDER BY id DESC");
  rows.bind(1, before > 0 ? before : std::numeric_limits<std::int64_t>::max());
  while (rows.executeStep()) {
    QuizAnswer answer;
    answer.id = rows.getColumn("id").getInt64();
    if (seen && !seen(answer.id)) continue;
    page.older = page.answers.size() == most;
    if (page.older) break;
    answer.trainee = rows.getColumn("trainee").getString();
    answer.case_name = rows.getColumn("case_name").getString();
    answer.case_fingerprint = rows.getColumn("case_fingerprint").getString();
    answer.seed = rows.getColumn("seed").getInt64();
    answer.question = rows.getColumn("question").getInt64();
    answer.answered_at = rows.getColumn("answered_at").getString();
    answer.place = rows.getColumn("place").getString();
    answer.depth_mm = rows.getColumn("depth_mm").getDouble();
    answer.answered = rows.getColumn("answered").getString();
    answer.next_view = rows.getColumn("next_view").getString();
    answer.is_view_right = rows.getColumn("is_view_right").getInt() != 0;
    answer.views_taken = rows.getColumn("views_taken").getInt64();
    page.answers.push_back(std::move(answer));
  }
  return page;
}

}  // namespace carpus::records::detail
