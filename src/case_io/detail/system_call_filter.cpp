// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/system_call_filter.hpp"

#include <seccomp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "core/is_sanitized.hpp"

namespace carpus::case_io {
namespace {

/// Harmless in themselves: memory, locks, the ways of an abort, time.
constexpr std::array kAllowed{SCMP_SYS(brk),
                              SCMP_SYS(munmap),
                              SCMP_SYS(madvise),
                              SCMP_SYS(futex),
                              SCMP_SYS(exit),
                              SCMP_SYS(exit_group),
                              SCMP_SYS(getpid),
                              SCMP_SYS(gettid),
                              SCMP_SYS(rt_sigaction),
                              SCMP_SYS(rt_sigprocmask),
                              SCMP_SYS(rt_sigreturn),
                              SCMP_SYS(sigaltstack),
                              SCMP_SYS(sched_yield),
                              SCMP_SYS(getrandom),
                              SCMP_SYS(clock_gettime),
                              SCMP_SYS(gettimeofday),
                              SCMP_SYS(sched_getaffinity),
                              SCMP_SYS(restart_syscall)};

/// What libraries ask in passing and can do without.
constexpr std::array kRefused{
    SCMP_SYS(open), SCMP_SYS(openat), SCMP_SYS(newfstatat), SCMP_SYS(fstat), SCMP_SYS(stat),
    SCMP_SYS(lseek), SCMP_SYS(ioctl), SCMP_SYS(read), SCMP_SYS(close), SCMP_SYS(access),
    SCMP_SYS(readlink), SCMP_SYS(prctl), SCMP_SYS(fcntl), SCMP_SYS(sysinfo), SCMP_SYS(getrusage),
    // threads: decoders go on without
    SCMP_SYS(clone), SCMP_SYS(clone3)};

bool add_rules(scmp_filter_ctx filter) {
  bool is_ok = true;
  for (const int call : kAllowed) {
    is_ok = is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) == 0;
  }
  for (const int call : kRefused) {
    if (kIsSanitized && call == SCMP_SYS(close)) continue;
    is_ok = is_ok && seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), call, 0) == 0;
  }
  if (kIsSanitized) {  // they ask whether memory is there by writing it into a pipe of their own
    for (const int call : {SCMP_SYS(pipe), SCMP_SYS(pipe2), SCMP_SYS(write), SCMP_SYS(close)}) {
      is_ok = is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) == 0;
    }
  }
  // Memory without a file behind it that is never code.
  const scmp_arg_cmp no_code = SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0);
  const scmp_arg_cmp anonymous = SCMP_A3(SCMP_CMP_MASKED_EQ, MAP_ANONYMOUS, MAP_ANONYMOUS);
  is_ok =
      is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(mmap), 2, no_code, anonymous) == 0;
  is_ok = is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(mprotect), 1, no_code) == 0;
  is_ok = is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(mremap), 0) == 0;
  const scmp_arg_cmp complaints = SCMP_A0(SCMP_CMP_EQ, STDERR_FILENO);
  if (!kIsSanitized) {
    is_ok = is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(write), 1, complaints) == 0;
  }
  is_ok = is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(writev), 1, complaints) == 0;
  const scmp_arg_cmp itself = SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()));
  return is_ok && seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1, itself) == 0;
}

}  // namespace

bool allow_decoding_only() noexcept {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_KILL_PROCESS);
  if (filter == nullptr) return false;
  const bool is_loaded = add_rules(filter) && seccomp_load(filter) == 0;
  seccomp_release(filter);
  return is_loaded;
}

}  // namespace carpus::case_io
