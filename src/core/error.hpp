// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Exceptions for setup, files, devices and user input. Their message says what, where, in which
// unit, and what to do about it; it is shown to the user as it is.
#pragma once

#include <stdexcept>
#include <string>

namespace carpus {

/// Base of all errors that a user can do something about.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value, an option or a data set that cannot be used as given.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// A file, folder, database or device that could not be read or written.
class IoError : public Error {
 public:
  using Error::Error;
};

/// Data written by another version of the program than this one understands.
class SchemaError : public Error {
 public:
  using Error::Error;
};

/// Wrong use of the command line; the program exits with status 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace carpus
