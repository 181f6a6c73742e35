#!/usr/bin/env bash
# Packs the programs of a build as the action and cargo-binstall unpack them: lobefit-TARGET.tgz in the current folder, with one folder
# of that name.
#
# Usage: package.sh FOLDER TARGET
set -euo pipefail
built=$1
name=lobefit-$2
suffix=
if [ -f "$built/lobefit.exe" ]; then suffix=.exe; fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/$name/man" "$work/$name/completions"
cp "$built/lobefit$suffix" "$built/lobefit-audit$suffix" "$built/lobefit-formula$suffix" "$built/lobefit-studies$suffix" \
  "$work/$name/"
cp "$(dirname "$0")/../../LICENSE" "$(dirname "$0")/../../README.md" "$work/$name/"
"$built/lobefit$suffix" man "$work/$name/man"
for shell in bash elvish fish powershell zsh; do
  "$built/lobefit$suffix" completions "$shell" >"$work/$name/completions/lobefit.$shell"
done
tar -czf "$name.tgz" -C "$work" "$name"
