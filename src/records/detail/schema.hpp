// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The schema of the records file and how one version becomes the next.
#pragma once

#include <array>

namespace carpus::records::detail {

/// "CARP", in the file's header: tells our files from other SQLite databases.
inline constexpr int kApplicationId = 0x43415250;

/// kMigrations[v] turns a file of version v into one of version v + 1; a new file begins at 0.
/// Never change one that was released: add the next.
inline constexpr std::array<const char*, 6> kMigrations{
    R"sql(
      CREATE TABLE attempt (
        id               INTEGER PRIMARY KEY AUTOINCREMENT,
        trainee          TEXT NOT NULL,
        case_name        TEXT NOT NULL,
        case_fingerprint TEXT NOT NULL,
        procedure        TEXT NOT NULL,
        input_device     TEXT NOT NULL,
        started_at       TEXT NOT NULL,
        ended_at         TEXT NOT NULL,
        outcome          TEXT NOT NULL CHECK (outcome IN ('unfinished', 'finished')),
        overall          REAL CHECK (overall BETWEEN 0 AND 100),
        duration_ticks   INTEGER NOT NULL,
        final_hash       TEXT NOT NULL,
        score            TEXT NOT NULL,
        events           TEXT NOT NULL,
        recording        BLOB NOT NULL
      );
      CREATE INDEX attempt_by_start ON attempt (started_at);
    )sql",
    // NULL where nobody noted it.
    R"sql(
      ALTER TABLE attempt ADD COLUMN case_simulated INTEGER CHECK (case_simulated IN (0, 1));
    )sql",
    // NULL where nobody gave one. The same attempt may come twice: from its journal after the
    // program was killed between storing and deleting, from a file that it was rescued to.
    R"sql(
      ALTER TABLE attempt ADD COLUMN origin TEXT;
      CREATE UNIQUE INDEX attempt_by_origin ON attempt (origin);
    )sql",
    // NULL of attempts from before there were two ways to operate.
    R"sql(
      ALTER TABLE attempt ADD COLUMN mode TEXT CHECK (mode IN ('practice', 'assessed'));
    )sql",
    // What was answered in the view quiz, a row a question.
    R"sql(
      CREATE TABLE quiz_answer (
        id               INTEGER PRIMARY KEY AUTOINCREMENT,
        trainee          TEXT NOT NULL,
        case_name        TEXT NOT NULL,
        case_fingerprint TEXT NOT NULL,
        seed             INTEGER NOT NULL,
        question         INTEGER NOT NULL,
        answered_at      TEXT NOT NULL,
        place            TEXT NOT NULL CHECK (place IN ('inside', 'distal', 'proximal', 'side')),
        depth_mm         REAL NOT NULL,
        answered         TEXT NOT NULL CHECK (answered IN ('inside', 'distal', 'proximal', 'side')),
        next_view        TEXT NOT NULL,
        is_view_right    INTEGER NOT NULL CHECK (is_view_right IN (0, 1)),
        views_taken      INTEGER NOT NULL
      );
    )sql",
    // How instructors rated arthroscopies, a row a rater and attempt. NULL while rows of the form
    // are missing.
    R"sql(
      CREATE TABLE asset_form (
        id       INTEGER PRIMARY KEY AUTOINCREMENT,
        attempt  INTEGER NOT NULL REFERENCES attempt (id),
        rater    TEXT NOT NULL CHECK (rater <> ''),
        revision INTEGER NOT NULL CHECK (revision > 0),
        saved_at TEXT NOT NULL,
        answers  TEXT NOT NULL,
        comment  TEXT NOT NULL,
        total    INTEGER CHECK (total >= 0),
        passes   INTEGER CHECK (passes IN (0, 1)),
        UNIQUE (attempt, rater),
        CHECK ((total IS NULL) = (passes IS NULL))
      );
    )sql",
};

}  // namespace carpus::records::detail
