#!/bin/bash
# What --help prints, the man page and the completions say the same: every verb and every long option is in all of them,
# and they name no option that the program does not have. No line of Markdown is too long to read in a terminal.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
man=$SCARP_SOURCE/docs/man/scarp.1
completions=$SCARP_SOURCE/completions

# Words that stand for themselves: not the beginning of a longer option.
names_option() { grep -Eq -- "(^|[^[:alnum:]-])$1([^[:alnum:]-]|\$)" "$2"; }
# The man page with its escapes undone.
sed -e 's/\\-/-/g' -e 's/\\f[RIBP]//g' "$man" >man.txt
# fish says `-l max-error` for --max-error.
sed -nE '/^complete/s/ -l ([a-z-]+)/ --\1/gp' "$completions/scarp.fish" >fish.txt

verbs=$("$scarp" --help | sed -n '/^Verbs:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ -n "$verbs" ] || fail "--help lists no verbs"
: >all_options
for verb in $verbs; do
  for text in man.txt "$completions/scarp.bash" "$completions/_scarp" fish.txt; do
    grep -qw -- "$verb" "$text" || fail "the verb $verb is missing in $text"
  done
  options=$("$scarp" "$verb" --help | sed -n '/^Examples:/q;p' | grep -oE -- '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+')
  [ "$(wc -w <<<"$options")" -gt 3 ] || fail "scarp $verb --help lists hardly any option"
  for option in $options; do
    echo "$option" >>all_options
    for text in man.txt "$completions/_scarp" fish.txt; do
      names_option "$option" "$text" || fail "$option of $verb is missing in $text"
    done
  done

  # bash: what is offered after the verb is exactly what --help lists.
  offered=$(bash -c 'source "$1"; COMP_WORDS=(scarp "$2" --); COMP_CWORD=2; _scarp; printf "%s\n" "${COMPREPLY[@]}"' \
    _ "$completions/scarp.bash" "$verb" | sort)
  [ "$offered" = "$(sort <<<"$options")" ] || fail "bash offers after $verb: $offered"
done

for text in man.txt "$completions/_scarp" fish.txt; do
  for option in $(grep -v '^#' "$text" | grep -oE -- '(^|[^[:alnum:]-])--[a-z][a-z-]+' | grep -oE -- '--[a-z-]+' | sort -u); do
    grep -qxF -- "$option" all_options || fail "$text names $option, which no verb has"
  done
done

bash -n "$completions/scarp.bash"
if command -v zsh >/dev/null; then zsh -n "$completions/_scarp" || fail "zsh cannot read _scarp"; fi
if command -v fish >/dev/null; then fish -n "$completions/scarp.fish" || fail "fish cannot read scarp.fish"; fi
if command -v groff >/dev/null; then
  groff -man -Tutf8 -ww -z "$man" 2>man.log || fail "groff refuses the man page"
  [ ! -s man.log ] || fail "groff warns about the man page: $(head -n 3 man.log)"
fi

if command -v python3 >/dev/null; then
  check_words=$SCARP_SOURCE/tools/check_words.py
  python3 "$check_words" "$SCARP_SOURCE" >words.txt || fail "a line of Markdown is too long: $(head -n 3 words.txt)"
  mkdir pages
  long_line=$(printf '%0161d' 0)
  printf '| %s |\n    %s\n```\n%s\n```\n' "$long_line" "$long_line" "$long_line" >pages/fine.md
  python3 "$check_words" pages >words.txt || fail "tables and code may have long lines: $(cat words.txt)"
  printf 'short\n%s\n' "$long_line" >pages/planted.md
  if python3 "$check_words" pages >words.txt; then fail "a line of 161 characters was not noticed"; fi
  [ "$(cat words.txt)" = "planted.md:2: 161 characters, at most 160" ] || fail "wrong words: $(cat words.txt)"
fi
echo "man page and completions agree with --help"
