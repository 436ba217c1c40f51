#!/bin/bash
# One table of options defines the text of --help, the man page, the completions and the page of all options, and the
# program accepts exactly its choices. The library's table of conflicts defines a page. The words of comments, help and
# docs are checked.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need python3
succeeds python3 "$SCARP_SOURCE/tools/generate_docs.py" "$scarp" share
man=share/man/man1/scarp.1
bash_completions=share/bash-completion/completions/scarp
zsh_completions=share/zsh/site-functions/_scarp
fish_completions=share/fish/vendor_completions.d/scarp.fish
# The build has made the same; a folder with only the program has none.
if [ -e "$SCARP_BUILD/CMakeCache.txt" ]; then
  for file in $(cd share && find . -type f); do
    cmp "share/$file" "$SCARP_BUILD/share/$file" || fail "the build has made another $file"
  done
fi

# Whole words: not the beginning of a longer option.
options_of() { grep -oE -- '(^|[^[:alnum:]-])--[[:alnum:]-]+' | grep -oE -- '--[[:alnum:]-]+' | sort -u; }
# The man page with its escapes undone.
sed -e 's/\\-/-/g' -e 's/\\f[RIBP]//g' "$man" >man.txt
# fish writes `-l max-error` for --max-error.
sed -nE '/^complete/s/ -l ([a-z-]+)/ --\1/gp' "$fish_completions" >fish.txt
for text in man.txt "$zsh_completions" fish.txt share/doc/scarp/options.md; do options_of <"$text" >"$text.options"; done

commands=$(once "$scarp" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
[ "$(wc -w <<<"$commands")" = 14 ] || fail "--help lists other commands: $commands"
once "$scarp" help >help.txt
once "$scarp" --help | cmp - help.txt || fail "scarp help and scarp --help differ"
: >all_options
for command in $commands; do
  for text in man.txt "$bash_completions" "$zsh_completions" fish.txt; do
    grep -qw -- "$command" "$text" || fail "the command $command is missing in $text"
  done
  once "$scarp" help "$command" >help.txt
  for help in --help -h; do
    once "$scarp" "$command" $help | cmp - help.txt || fail "scarp help $command and scarp $command $help differ"
  done
  [ -z "$(awk 'length > 100' help.txt)" ] || fail "$command --help has a long line: $(awk 'length > 100' help.txt)"
  once "$scarp" help "$command" --all >help.txt
  once "$scarp" "$command" --help-all | cmp - help.txt || fail "scarp help $command --all and scarp $command --help-all differ"
  [ -z "$(awk 'length > 100' help.txt)" ] || fail "$command --help-all has a long line: $(awk 'length > 100' help.txt)"
  options=$(sed '/^Examples:/q' help.txt | grep -oE -- '^(  -[a-z], |      )--[a-z-]+' | grep -oE -- '--[a-z-]+')
  [ "$(wc -w <<<"$options")" -ge 3 ] || fail "scarp $command --help lists hardly any option"
  echo "$options" >>all_options
  for text in man.txt "$zsh_completions" fish.txt share/doc/scarp/options.md; do
    missing=$(comm -23 <(sort -u <<<"$options") "$text.options")
    [ -z "$missing" ] || fail "of $command is missing in $text: $missing"
  done

  # bash offers after the command exactly the options of --help.
  offered=$(bash -c 'source "$1"; COMP_WORDS=(scarp "$2" --); COMP_CWORD=2; _scarp; printf "%s\n" "${COMPREPLY[@]}"' \
    _ "$bash_completions" "$command" | sort)
  [ "$command" != classic ] || offered=$(comm -12 <(echo "$offered") <(sort <<<"$options")) # it has those of simplify, too
  [ "$offered" = "$(sort <<<"$options")" ] || fail "bash offers after $command: $offered"
done
# The first page fits a screen: goals first, eight examples, and the reference to the rest, which lists rare options
# last.
once "$scarp" simplify -h >help.txt
for command in $commands; do
  [ "$(once "$scarp" "$command" -h | wc -l)" -le 40 ] || fail "scarp $command -h is longer than a screen"
done
[ "$(grep -c '^  scarp simplify ' help.txt)" = 8 ] || fail "scarp simplify -h has not eight examples"
grep -A 1 '^Goals' help.txt | grep -q -- '--max-error' || fail "scarp simplify -h does not begin with the goals"
grep -q -- '--help-all' help.txt || fail "scarp simplify -h does not name --help-all"
once "$scarp" simplify --help-all | grep '^[A-Z].*:$' | sed 's/[ :].*//' | xargs >groups.txt
[[ $(<groups.txt) == "Arguments Goals "*" Textures Scattered Old Examples" ]] || fail "groups in another order: $(<groups.txt)"
[ "$(once "$scarp" version)" = "$(once "$scarp" --version)" ] || fail "scarp version and scarp --version differ"

offered=$(bash -c 'source "$1"; COMP_WORDS=(scarp simplify --effort h); COMP_CWORD=3; _scarp; echo "${COMPREPLY[@]}"' \
  _ "$bash_completions")
[ "$offered" = high ] || fail "bash offers after --effort: $offered"

sort -u all_options >known
for text in man.txt "$zsh_completions" fish.txt; do
  unknown=$(comm -23 <(grep -v '^#' "$text" | options_of | grep -- '--[a-z][a-z-]') known)
  [ -z "$unknown" ] || fail "$text names what no command has: $unknown"
done

# The page of conflicts names options of commands, and a pair of its table is refused for that reason.
conflicts=share/doc/scarp/conflicts.md
grep -qF '| `--lods` | `--effort time-limit` |  | the finest level would take the time of all |' "$conflicts" || fail "no row on --lods"
grep -qF '| `--drape` | `--grid local` | images are' "$conflicts" || fail "no row on tiles"
grep -q 'samples in memory' "$conflicts" && grep -qF '`--script` (lines s)' "$conflicts" || fail "rows without their words"
unknown=$(comm -23 <(grep -oE -- '--[a-z][a-z-]+' "$conflicts" | sort -u) known)
[ -z "$unknown" ] || fail "the page of conflicts names what no command has: $unknown"
refuses 1 "the finest level would take the time of all" "$scarp" simplify "$dem" x.glb -e 5 --lods 3 --time-limit 60

bash -n "$bash_completions"
if command -v zsh >/dev/null; then zsh -n "$zsh_completions" || fail "zsh cannot read _scarp"; fi
if command -v fish >/dev/null; then fish -n "$fish_completions" || fail "fish cannot read scarp.fish"; fi
if command -v groff >/dev/null; then
  groff -man -Tutf8 -ww -z "$man" 2>man.log || fail "groff refuses the man page"
  [ ! -s man.log ] || fail "groff warns about the man page: $(head -n 3 man.log)"
fi

# A stable table of options, with the choices that the program names.
once "$scarp" help --json >table.json
python3 - table.json >choices.txt <<'END' || fail "the table of options is wrong"
import json, re, sys
table = json.load(open(sys.argv[1]))
seen = set()
for row in table["options"]:
    key = row["command"], row["name"]
    assert key not in seen, f"{key} twice"
    seen.add(key)
    assert list(row) == ["name", "short", "command", "part_of", "key", "group", "type", "value", "unit", "default", "range", "choices",
                         "repeatable", "required", "help", "brief"], row
    assert row["help"].endswith(".") and row["help"][0].isupper(), row["help"]
    assert len(re.split(r"\.(?: |$)", row["help"])[0]) <= 160, f"{key}: a first sentence too long for completions"
    assert (row["type"] != "choice") or len(row["choices"]) > 1, row
    if row["type"] == "choice" and row["name"].startswith("-"):
        print(row["command"], row["name"], *row["choices"])
names = [command["name"] for command in table["commands"]]
assert names == [row["choices"] for row in table["options"] if row["name"] == "COMMAND"][0], names
END
printf 'x,y,z\n0,0,1\n9,0,2\n0,9,3\n' >points.csv
while read -r command option choices; do
  case "$command $option" in
    "simplify --duplicates") try "$scarp" simplify points.csv out.obj -e 1 "$option" nonsense ;;
    "measure --duplicates" | "measure --returns") continue ;; # asked after the mesh is read
    "simplify --returns") try "$scarp" simplify points.csv out.obj -e 1 --class returns=nonsense ;;
    "info --returns") try "$scarp" info points.csv --class returns=nonsense ;;
    "tile --duplicates") try "$scarp" tile points.csv out "$option" nonsense ;;
    "tile --returns") try "$scarp" tile points.csv out --class returns=nonsense ;;
    "simplify --norm") try "$scarp" simplify "$dem" out.obj -e 1 --image "$option" nonsense ;;
    "simplify --drape-format") try "$scarp" simplify "$dem" out.glb -e 1 --drape "$dem,format=nonsense" ;;
    "simplify --line-conflict") try "$scarp" simplify "$dem" out.obj -e 1 --breaklines lines,conflict=nonsense ;;
    "measure --norm") try "$scarp" measure "$dem" out.obj --image "$option" nonsense ;;
    "classic --duplicates" | "classic --returns" | "classic --norm" | "classic --drape-format" | "classic --line-conflict") continue ;; # of simplify
    "classic --edge-score") try "$scarp" classic "$dem" out.obj -e 1 --edges data "$option" nonsense ;;
    classic*) try "$scarp" classic "$dem" out.obj -e 1 "$option" nonsense ;;
    simplify*) try "$scarp" simplify "$dem" out.obj -e 1 "$option" nonsense ;;
    view*) try "$scarp" view out.obj "$dem" "$option" nonsense ;;
    measure*) try "$scarp" measure "$dem" out.obj "$option" nonsense ;;
    "tile-check --grid") continue ;; # asked after the set is read: test_tile_local.sh asks it
    tile*" --drape-format") try "$scarp" tile "$dem" out --of 3dtiles --drape "$dem,format=nonsense" ;;
    "tile-plan --hash") try "$scarp" tile-plan "$dem" out.json "$option" nonsense ;;
    tile*) try "$scarp" tile "$dem" out "$option" nonsense ;;
    serve*) try "$scarp" serve "$dem" "$option" nonsense ;;
    info*) try "$scarp" info "$dem" "$option" nonsense ;;
    generate*) try "$scarp" generate cliff 9 9 out.tif "$option" nonsense ;;
  esac
  [ "$code" = 1 ] || fail "$command $option nonsense ends with $code"
  named=$(sed -E 's/.*choose //; s/ or /, /; s/,//g' "$logs/err" | tr ' ' '\n' | sort | xargs)
  [ "$named" = "$(tr ' ' '\n' <<<"$choices" | sort | xargs)" ] || fail "$command $option: $choices, but the program says $named"
done <choices.txt

# Messages name options by row: few names are literals in the sources.
literals=$(cd "$SCARP_SOURCE" && grep -rhE '"--[a-z]' --include='*.cpp' --include='*.h' --exclude='option_rows_*' src apps bindings/c |
  grep -vcE '^ *//|//.*"--[a-z]')
[ "$literals" -le 60 ] || fail "$literals names of options stand outside of the table, more than 60"
own=$(python3 -c 'import json, sys; print(sum(r["command"] == "simplify" and r["name"][0] == "-" and not r["part_of"]
  for r in json.load(sys.stdin)["options"]))' <table.json)
[ "$own" -le 70 ] || fail "simplify has $own options, more than 70"

check_words=$SCARP_SOURCE/tools/check_words.py
python3 "$check_words" "$SCARP_SOURCE" >words.txt || fail "words: $(head -n 3 words.txt)"
mkdir pages
long_line=$(printf '%0161d' 0)
printf '| %s |\n    %s\n```\n%s\n```\n' "$long_line" "$long_line" "$long_line" >pages/fine.md
python3 "$check_words" pages >words.txt || fail "tables and code may have long lines: $(cat words.txt)"
printf 'short\n%s\n' "$long_line" >pages/planted.md
if python3 "$check_words" pages >words.txt; then fail "a line of 161 characters was not noticed"; fi
[ "$(cat words.txt)" = "planted.md:2: 161 characters, at most 160" ] || fail "wrong words: $(cat words.txt)"
echo "man page, completions and the page of all options agree with the table of options"
