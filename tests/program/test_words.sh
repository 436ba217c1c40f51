#!/bin/bash
# tools/check_words.py finds planted fragments and words in comments, docstrings and help, but not in code.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need python3
check_words=$SCARP_SOURCE/tools/check_words.py
mkdir -p tree/src tree/apps tree/bindings tree/tests

cat >tree/src/fine.h <<'CPP'
/// True if `take` is set; "left out" is a message, and look() a call.
bool takes_all(char quote = '"');  // tell_all() and run.say are names
const char* nobody = "nobody // says this";
CPP
cat >tree/bindings/fine.py <<'PYTHON'
"""The width of a cell."""
say = "what"  #: a word
PYTHON
cat >tree/tests/fine.js <<'JAVASCRIPT'
const quote = /["']/;  // a pattern with quotes
JAVASCRIPT
python3 "$check_words" tree >words.txt || fail "fine words are refused: $(cat words.txt)"

cat >tree/src/planted.h <<'CPP'
struct Line {
  double length;  ///< of the line
  int kind;       ///< the kind, as given;
                  ///< nobody
                  ///< looks at it
};
CPP
cat >tree/bindings/planted.py <<'PYTHON'
def width():
    """What the field tells."""
PYTHON
printf 'true  %s which goes on\n' '#' >tree/tests/planted.sh
cat >tree/apps/option_rows_planted.cpp <<'CPP'
Row row{.by_default = "as the file", .help = "Where it lies, "
                                             "beside the mesh."};
CPP
if python3 "$check_words" tree >words.txt; then fail "planted words were not noticed"; fi
sed 's/: use .*\|: [a-z, ]*$//' words.txt | sort >found.txt
sort >expected.txt <<'WORDS'
apps/option_rows_planted.cpp:1: a help text begins with "Where"
apps/option_rows_planted.cpp:2: "beside"
bindings/planted.py:2: a comment begins with "What"
bindings/planted.py:2: "tells"
src/planted.h:2: a comment begins with "of"
src/planted.h:4: "nobody"
src/planted.h:5: "looks"
tests/planted.sh:1: a comment begins with "which"
tests/planted.sh:1: "goes on"
WORDS
diff expected.txt found.txt >difference.txt || fail "other words were found: $(cat difference.txt words.txt)"
echo "words of comments and help are checked"
