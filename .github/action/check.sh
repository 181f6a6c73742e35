#!/usr/bin/env bash
# Runs `lobefit check` and shows what it finds where GitHub shows results: an annotation for each file, or one for a scene that
# changed, and a summary with the errors that the manifest states. Its exit code is that of `lobefit check`.
#
# Usage: check.sh PROGRAM, with SCENE, AGAINST, OPTIONS, ONLY and VALUES as action.yml describes them, and GITHUB_STEP_SUMMARY.
# Programs of jq stand in single quotes.
# shellcheck disable=SC2016
set -uo pipefail
program=$1
against=${AGAINST:-.}
# Words of the bake's command, which the command to bake again has too.
read -ra baked <<<"${OPTIONS:-}"
options=(--against "$against" --json ${baked[@]+"${baked[@]}"})
if [ -n "${VALUES:-}" ]; then options+=(--values "$VALUES"); fi
if [ -n "${ONLY:-}" ]; then options+=(--only "$ONLY"); fi
if [ -n "${SCENE:-}" ]; then options+=(-- "$SCENE"); fi

messages=$(mktemp)
trap 'rm -f "$messages"' EXIT
verdict=$("$program" check "${options[@]}" 2>"$messages")
code=$?
cat "$messages" >&2

# As the runner's commands escape what they are given.
escape='def text: gsub("%"; "%25") | gsub("\r"; "%0D") | gsub("\n"; "%0A");
  def property: text | gsub(":"; "%3A") | gsub(","; "%2C");'

if [ "$code" -gt 1 ]; then
  jq -Rrs "$escape"' "::error title=lobefit check::" + (rtrimstr("\n") | text)' <"$messages"
  exit "$code"
fi

# Of another scene every file is another: the change is what there is to say, and what else is at fault lies beside the bake.
# What lies beside a bake, and files that are none of it, no bake mends.
facts='def changed: .scene_changes // [];
  def is_beside: .file | test("^reports/(studies|gpu|isa)/");
  def is_mended: any(.differences[]; .kind != "extra" and (is_beside | not));
  def broken: .promises_not_kept // [];
  def is_changed: (changed | length > 0) and (broken | length == 0);
  def faults: is_changed as $is | .differences[] | select(($is | not) or is_beside);
  def for_shaders: if (.changed_for_shaders // []) == [] then "no number and no code that a shader reads changed"
    else "numbers or code that a shader reads changed in " + (.changed_for_shaders | join(", ")) end;'
bake="lobefit bake${SCENE:+ $(printf %q "$SCENE")}"
if [ "${#baked[@]}" -gt 0 ]; then bake+=" ${baked[*]}"; fi
if [ "$against" != . ]; then bake+=" --out $(printf %q "$against")"; fi

folder=${against%/}/
folder=${folder#./}
scene=${SCENE:-}
scene=${scene#./}
jq -r --arg folder "$folder" --arg scene "${scene:-${folder}manifest.json}" --arg bake "$bake" "$escape$facts"'
  def error(file; says): "::error file=" + (file | property) + ",title=lobefit check::" + (says | text);
  select(.same | not) | (broken[] | error($scene; "promise not kept: " + .)),
  (select(broken != [] and changed != []) | error($scene; "the scene changed: " + (changed | join("; ")))),
  (select(is_changed) | error($scene; (changed | join("; ")) + "; " + for_shaders + "; run " + $bake)),
  (faults | error($folder + .file; .detail))' <<<"$verdict"

# Without a runner the summary goes where the rest goes.
if [ -n "${GITHUB_STEP_SUMMARY:-}" ]; then exec >>"$GITHUB_STEP_SUMMARY"; fi
# A cell of a table: no line ends, no bars.
cell='def cell: tostring | gsub("[\r\n|]"; " "); def row: "| " + (map(cell) | join(" | ")) + " |";
  def digits: if . == 0 then 0 else (log10 | floor) as $e | pow(10; 2 - $e) as $s | (. * $s | round) / $s end;'
echo "## lobefit check: $against"
echo
jq -r --arg bake "$bake" "$cell$facts"' if .same then "Every file follows from its recipe." else
  (broken | select(length > 0) | "The scene asks for what nothing keeps; no bake follows from it:", "",
    (.[] | split("\n") | "- " + (.[0] | cell), (.[1:][] | "  - " + (ltrimstr("  ") | cell)))),
  (changed | select(length > 0) | "", "The scene changed:", "", (.[] | "- " + cell)),
  (select(is_changed) | "", (for_shaders | (.[:1] | ascii_upcase) + .[1:] + "."), "", "Bake it again: `" + $bake + "`"),
  ([faults] | select(length > 0) | "", "| file | what differs |", "|---|---|", (.[] | ["`" + .file + "`", .detail] | row)),
  (select(is_mended and (is_changed | not)) | "", "Bake it again: `" + $bake + "`")
  end' <<<"$verdict"
echo
if [ -f "$against/manifest.json" ]; then
  jq -r "$cell"' (.tables | select(length > 0) |
      "| table | quantity | largest error | RMS | bytes | operations |", "|---|---|--:|--:|--:|--:|",
      (.[] | [.name, .quantity, .error.lookup.max, (.error.lookup.rms | digits), .bytes, .cost.ops] | row), ""),
    (.fits | select(length > 0) |
      "| function | quantity | use | largest error | RMS | operations |", "|---|---|---|--:|--:|--:|",
      (.[] | [.function, .quantity, .use, .certificate.max_abs, (.certificate.rms | digits), .cost.ops] | row))' \
    "$against/manifest.json"
fi
exit "$code"
