// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/request_head.hpp"

#include <algorithm>
#include <utility>

namespace carpus::server {

namespace {

constexpr std::string_view kLineEnd = "\r\n";

/// Thrown and caught in this file alone.
struct Refused {
  RequestProblem problem;
};

[[noreturn]] void refuse(unsigned status, std::string reason) {
  throw Refused{{status, std::move(reason)}};
}

/// tchar of RFC 9110 §5.6.2
bool is_token_character(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') ||
         (c != '\0' && std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos);
}

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_token_character);
}

/// Visible characters, spaces, tabs, and bytes of other alphabets; no control character.
bool is_field_character(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return c == '\t' || (byte >= 0x20 && byte != 0x7F);
}

bool is_visible(char c) { return c > 0x20 && c < 0x7F; }

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Takes the first line off `rest`.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find(kLineEnd);
  if (end == std::string_view::npos) refuse(400, "The request's head does not end.");
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + kLineEnd.size());
  return line;
}

/// "http://authority/path?query" becomes its authority and "/path?query".
std::pair<std::string_view, std::string> split_absolute_form(std::string_view target) {
  std::string_view rest;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (lower(target.substr(0, scheme.size())) == scheme) rest = target.substr(scheme.size());
  }
  if (rest.empty()) refuse(400, "The request's target is neither a path nor an address.");
  const std::size_t slash = std::min(rest.find_first_of("/?"), rest.size());
  std::string path(rest.substr(slash));
  if (!path.starts_with('/')) path.insert(0, "/");
  return {rest.substr(0, slash), std::move(path)};
}

void read_version(std::string_view version, RequestHead& head) {
  const bool has_form = version.size() == 8 && version.starts_with("HTTP/") && version[6] == '.' &&
                        version[5] >= '0' && version[5] <= '9' && version[7] >= '0' &&
                        version[7] <= '9';
  if (!has_form) refuse(400, "The request's first line is malformed.");
  if (version != "HTTP/1.1" && version != "HTTP/1.0") {
    refuse(505, "Only HTTP/1.0 and HTTP/1.1 are spoken here.");
  }
  head.is_http_1_1 = version == "HTTP/1.1";
}

/// Whether a target is the address, with or without a query.
bool is_at(std::string_view target, std::string_view address) {
  return target.substr(0, target.find('?')) == address;
}

bool is_spoken(std::string_view method) {
  return method == "GET" || method == "HEAD" || method == "POST" || method == "PUT" ||
         method == "DELETE";
}

/// Only where what they change is: elsewhere they are refused whatever else they say.
void refuse_method(const RequestHead& head) {
  const std::string& method = head.method;
  if (method == "GET" || method == "HEAD") return;
  const bool changes_here =
      (method == "PUT" && (is_at(head.target, kNewCaseFilePath) || is_at(head.target, kAssetPath) ||
                           is_at(head.target, kPathologyPath))) ||
      (method == "DELETE" && is_at(head.target, kNewCasePath)) ||
      (method == "POST" &&
       (is_at(head.target, kNewCasePath) || is_at(head.target, kNewCaseRunPath)));
  if (!changes_here) refuse(405, "Only GET and HEAD are answered here.");
}

/// @return the authority of an absolute form; empty of a path
std::string read_request_line(std::string_view line, RequestHead& head) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) {
    refuse(400, "The request's first line is malformed.");
  }
  const std::string_view method = line.substr(0, first);
  const std::string_view target = line.substr(first + 1, last - first - 1);
  if (!is_token(method)) refuse(400, "The request's method is malformed.");
  read_version(line.substr(last + 1), head);
  if (!is_spoken(method)) refuse(405, "Only GET and HEAD are answered here.");
  if (target.empty() || !std::all_of(target.begin(), target.end(), is_visible) ||
      target.find('#') != std::string_view::npos) {
    refuse(400, "The request's target has characters that none may have.");
  }
  head.method = method;
  if (target.front() == '/') {
    head.target = target;
    refuse_method(head);
    return {};
  }
  auto [authority, path] = split_absolute_form(target);
  if (authority.empty()) refuse(400, "The request's target names no host.");
  head.target = std::move(path);
  refuse_method(head);
  return std::string(authority);
}

void read_field(std::string_view line, RequestHead& head) {
  if (line.front() == ' ' || line.front() == '\t') {
    refuse(400, "A folded header field is not accepted.");
  }
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon))) {
    refuse(400, "A header field's name is malformed.");
  }
  const std::string_view value = line.substr(colon + 1);
  if (!std::all_of(value.begin(), value.end(), is_field_character)) {
    refuse(400, "A header field has control characters.");
  }
  if (head.fields.size() >= kMaxHeadFields) refuse(431, "The request has too many header fields.");
  head.fields.push_back({lower(line.substr(0, colon)), std::string(trimmed(value))});
}

/// The field that may be there once; nothing where it is not.
std::optional<std::string_view> find_only(const RequestHead& head, std::string_view name) {
  const auto count = std::count_if(head.fields.begin(), head.fields.end(),
                                   [&](const RequestField& field) { return field.name == name; });
  if (count > 1) refuse(400, "The header field " + std::string(name) + " is there twice.");
  return head.find(name);
}

/// Of these a second would be another's to believe.
void refuse_doubles(const RequestHead& head) {
  for (const std::string_view name : {"origin", "sec-websocket-key", "sec-websocket-version"}) {
    (void)find_only(head, name);
  }
}

void read_authority(const std::string& absolute, RequestHead& head) {
  const auto host = find_only(head, "host");
  if (!host || host->empty()) refuse(400, "The request does not say which host it is for.");
  if (!absolute.empty() && lower(absolute) != lower(*host)) {
    refuse(400, "The request's target and its Host field name different hosts.");
  }
  head.authority = *host;
}

/// Of a PUT: its length, which must be said in plain digits and be neither none nor too much.
std::uint64_t read_length(std::string_view digits) {
  constexpr std::size_t kMostDigits = 10;
  std::uint64_t length = 0;
  if (digits.size() > kMostDigits) refuse(413, "The file is larger than is taken here.");
  for (const char digit : digits) length = 10 * length + static_cast<std::uint64_t>(digit - '0');
  if (length > kMaxBodyBytes) refuse(413, "The file is larger than is taken here.");
  if (length == 0) refuse(400, "The file is empty.");
  return length;
}

void read_body(RequestHead& head) {
  const auto length = find_only(head, "content-length");
  const auto encoding = find_only(head, "transfer-encoding");
  if (length && encoding) refuse(400, "The request states the length of its body twice.");
  if (encoding) {
    if (lower(*encoding) != "chunked") refuse(400, "The request's transfer coding is unknown.");
    refuse(413, "Requests have no body here.");
  }
  const bool takes_body = head.method == "PUT";
  if (!length && takes_body) refuse(411, "The request does not say how long its file is.");
  if (!length) return;
  if (length->empty() || length->find_first_not_of("0123456789") != std::string_view::npos) {
    refuse(400, "The length of the request's body is no number.");
  }
  if (takes_body) {
    head.body_bytes = read_length(*length);
  } else if (length->find_first_not_of('0') != std::string_view::npos) {
    refuse(413, "Requests have no body here.");
  }
}

/// Whether a list of tokens, of all fields of this name, has this one.
bool lists(const RequestHead& head, std::string_view name, std::string_view token) {
  for (const RequestField& field : head.fields) {
    if (field.name != name) continue;
    std::string_view rest = field.value;
    while (!rest.empty()) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      if (lower(trimmed(rest.substr(0, comma))) == token) return true;
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
  }
  return false;
}

RequestHead parse(std::string_view rest) {
  RequestHead head;
  const std::string absolute = read_request_line(take_line(rest), head);
  for (std::string_view line = take_line(rest); !line.empty(); line = take_line(rest)) {
    read_field(line, head);
  }
  if (!rest.empty()) refuse(400, "Something follows the request's head.");
  read_authority(absolute, head);
  refuse_doubles(head);
  read_body(head);
  head.keep_alive = head.is_http_1_1 ? !lists(head, "connection", "close")
                                     : lists(head, "connection", "keep-alive");
  return head;
}

}  // namespace

std::optional<std::string_view> RequestHead::find(std::string_view name) const {
  for (const RequestField& field : fields) {
    if (field.name == name) return field.value;
  }
  return std::nullopt;
}

HeadEnd find_head_end(std::string_view bytes, std::size_t scanned) {
  const std::size_t limit = std::min(bytes.size(), kMaxHeadBytes);
  for (std::size_t i = std::min(scanned, limit); i < limit; ++i) {
    if (bytes[i] == '\0') return {0, RequestProblem{400, "The request has a zero byte."}};
    if (bytes[i] != '\n') {
      if (i > 0 && bytes[i - 1] == '\r') {
        return {0, RequestProblem{400, "A line ends with a carriage return alone."}};
      }
      continue;
    }
    if (i == 0 || bytes[i - 1] != '\r') {
      return {0, RequestProblem{400, "A line ends without a carriage return."}};
    }
    if (i == 1) return {0, RequestProblem{400, "The request begins with an empty line."}};
    if (i >= 3 && bytes[i - 3] == '\r' && bytes[i - 2] == '\n') return {i + 1, {}};
  }
  if (bytes.size() >= kMaxHeadBytes) {
    return {0, RequestProblem{431, "The request's head is longer than 16 KiB."}};
  }
  return {};
}

std::variant<RequestHead, RequestProblem> parse_request_head(std::string_view head) {
  try {
    return parse(head);
  } catch (Refused& refused) {
    return std::move(refused.problem);
  }
}

}  // namespace carpus::server
