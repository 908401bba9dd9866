# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced by ./run: says before the long work that the port is taken, and by whom. The server itself
# says it only once it starts, which on a fresh machine is ten minutes later.

# who_answers ADDRESS PORT: prints "carpus" or "other"; nothing where nobody listens.
who_answers() {
  timeout 2 bash -c '
    exec 2>/dev/null 3<>"/dev/tcp/$0/$1" || exit
    who=other
    trap "echo \$who" EXIT
    trap exit TERM
    printf "HEAD / HTTP/1.1\r\nHost: localhost:%s\r\nConnection: close\r\n\r\n" "$1" >&3
    while read -r -t 1 line <&3; do
      case $line in [Ss]erver:\ carpus*) who=carpus && exit ;; esac
    done' "$1" "$2" || true
}

# require_free_port ADDRESS PORT LINK_PAGE: the last is the page that leads to a running trainer's link.
require_free_port() {
  local address=$1 port=$2 link_page=$3 who free open_it="the link that it printed"
  case $address in 0.0.0.0) address=127.0.0.1 ;; ::) address=::1 ;; esac
  [[ $port =~ ^[0-9]+$ ]] && [ "$port" -ne 0 ] || return 0
  who=$(who_answers "$address" "$port")
  [ -n "$who" ] || return 0
  # One that speaks TLS does not say in the clear who it is.
  if grep -qs ":$port/" "$link_page"; then
    who=carpus
    open_it="$PWD/$link_page in your browser"
  fi
  free=$((port + 1))
  while [ "$free" -lt 65535 ] && [ -n "$(who_answers "$address" "$free")" ]; do free=$((free + 1)); done
  [ "$who" = carpus ] ||
    fail "port $port is taken by another program. Stop that one, or choose another port: ./run --port $free"
  fail "Carpus is running already, on port $port: open $open_it. To start anew, stop that one first (Ctrl+C where it runs); to run a second one beside it: ./run --port $free"
}
