// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/detail/asset_form_table.hpp"

#include <SQLiteCpp/Statement.h>

#include <algorithm>
#include <utility>

namespace carpus::records::detail {

namespace {

bool has_attempt(const SQLite::Database& database, std::int64_t attempt) {
  SQLite::Statement row(database, "SELECT 1 FROM attempt WHERE id = ?");
  row.bind(1, attempt);
  return row.executeStep();
}

}  // namespace

AssetSaving save(SQLite::Database& database, const AssetForm& form, std::int64_t amended) {
  if (!has_attempt(database, form.attempt)) return AssetSaving::NoAttempt;
  const std::vector<AssetForm> known = read_forms(database, form.attempt);
  const auto same = std::find_if(known.begin(), known.end(),
                                 [&](const AssetForm& each) { return each.rater == form.rater; });
  if ((same == known.end() ? 0 : same->revision) != amended) return AssetSaving::Stale;
  if (same == known.end() && known.size() >= kMostAssetForms) return AssetSaving::Full;
  SQLite::Statement insert(
      database,
      "INSERT INTO asset_form (attempt, rater, revision, saved_at, answers, comment, total, "
      "passes) VALUES (:attempt, :rater, :revision, :saved_at, :answers, :comment, :total, "
      ":passes) ON CONFLICT (attempt, rater) DO UPDATE SET revision = excluded.revision, "
      "saved_at = excluded.saved_at, answers = excluded.answers, comment = excluded.comment, "
      "total = excluded.total, passes = excluded.passes");
  insert.bind(":attempt", form.attempt);
  insert.bind(":rater", form.rater);
  insert.bind(":revision", amended + 1);
  insert.bind(":saved_at", form.saved_at);
  insert.bind(":answers", form.answers_json);
  insert.bind(":comment", form.comment);
  if (form.total) insert.bind(":total", *form.total);
  if (form.passes) insert.bind(":passes", *form.passes ? 1 : 0);
  insert.exec();
  return AssetSaving::Saved;
}

std::vector<AssetForm> read_forms(const SQLite::Database& database, std::int64_t attempt) {
  std::vector<AssetForm> forms;
  SQLite::Statement rows(database, "SELECT * FROM asset_form WHERE attempt = ? ORDER BY id");
  rows.bind(1, attempt);
  while (rows.executeStep()) {
    AssetForm form;
    form.attempt = attempt;
    form.rater = rows.getColumn("rater").getString();
    form.revision = rows.getColumn("revision").getInt64();
    form.saved_at = rows.getColumn("saved_at").getString();
    form.answers_json = rows.getColumn("answers").getString();
    form.comment = rows.getColumn("comment").getString();
    const SQLite::Column total = rows.getColumn("total");
    if (!total.isNull()) form.total = total.getInt();
    const SQLite::Column passes = rows.getColumn("passes");
    if (!passes.isNull()) form.passes = passes.getInt() != 0;
    forms.push_back(std::move(form));
  }
  return forms;
}

}  // namespace carpus::records::detail
