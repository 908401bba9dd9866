# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
#
# cmake -DSOURCE=DIR -DOUT=FILE -P write_commit.cmake: the commit that is being built, for the results'
# provenance; "-dirty" when the tree differs from it. Writes only what changed.
execute_process(COMMAND git describe --always --dirty --exclude=* WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT ${OUT} CONTENT "#define CARPUS_BENCH_COMMIT \"@commit@\"\n" @ONLY)
