#!/usr/bin/env bash
# Installs lobefit below a folder: the binary of the release that the workflow names, else a build of the action's own sources.
#
# Usage: install.sh FOLDER, with ACTION_REPOSITORY, ACTION_REF and GH_TOKEN as GitHub gives them.
set -euo pipefail
folder=$1

case "$(uname -s)-$(uname -m)" in
Linux-x86_64) target=x86_64-unknown-linux-gnu ;;
Linux-aarch64) target=aarch64-unknown-linux-gnu ;;
Darwin-arm64) target=aarch64-apple-darwin ;;
MINGW*-x86_64 | MSYS*-x86_64) target=x86_64-pc-windows-msvc ;;
*) target= ;;
esac

mkdir -p "$folder/bin"
if [ -n "$target" ] && [[ "${ACTION_REF:-}" == v* ]] && command -v gh >/dev/null; then
  archive=lobefit-$target.tgz
  if gh release download "$ACTION_REF" --repo "$ACTION_REPOSITORY" --pattern "$archive" --dir "$folder" --clobber; then
    tar -xzf "$folder/$archive" -C "$folder/bin" --strip-components 1
    exit
  fi
  echo "no release $ACTION_REF for $target: building from source"
fi
cd "$(dirname "$0")/../.."
cargo build --release --locked --target-dir "$folder/target"
for name in lobefit lobefit-audit lobefit-formula lobefit-studies; do
  for suffix in "" .exe; do
    if [ -f "$folder/target/release/$name$suffix" ]; then cp "$folder/target/release/$name$suffix" "$folder/bin/"; fi
  done
done
