# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
