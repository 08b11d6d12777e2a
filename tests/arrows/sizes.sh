#!/usr/bin/env bash
# sizes.sh ROOT: a file is read in one sitting, a folder seen at a glance. No file of cl and lib has more
# than 350 lines, no folder more than 20 files of one kind. Prints each that does, and fails.
set -euo pipefail
cd "$1"
most_lines=350 most_files=20

# Those that may, and why.
exceptions='
cl/shared/plait/params.h           a list, which users install as one file
cl/shared/plait/stages.def         a list, which users install as one file
cl/mesh/mesh_nearest.cl            one walk through a tree, whose parts share what it has found
cl/strand_contact/contact_pair_find.cl     one walk through cells, whose parts share what it has found
cl/strands/articulated.clh         one recursion, whose passes share the factors of the joints
lib/core/sim/sim.hpp               the object in which all rooms meet, with what it is made of
'

{
    find cl lib -type f -exec wc -l {} + | awk -v most=$most_lines '$2 != "total" { print $2, $1, most, "lines" }'
    find cl lib tests/cases -type f | sed -E 's,/[^/]*\.([a-z]+)$,/*.\1,' | sort | uniq -c |
        awk -v most=$most_files '{ print $2, $1, most, "files" }'
} | awk -v exceptions="$exceptions" '
    BEGIN {
        lines = split(exceptions, line, "\n")
        for (i = 1; i <= lines; i++) if (split(line[i], word, " ")) excepted[word[1]] = 1
    }
    $2 > $3 && !($1 in excepted) { print $1 ": " $2 " " $4 ", allowed " $3; bad++ }
    $2 <= $3 && $1 in excepted { print $1 ": needs no exception"; bad++ }
    END {
        if (!NR) { print "no file found: wrong root?"; exit 1 }
        exit bad > 0
    }'
