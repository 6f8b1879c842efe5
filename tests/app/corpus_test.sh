#!/usr/bin/env bash
# corpus_test.sh PALPA-CLI: scripts/corpus on a few small files: touched, refused, packed, a crash and a hang (of a
# stand-in for palpa-cli); a second run only does the missing files.
set -euo pipefail
cli=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
files=$work/files
out=$work/out
mkdir "$files"

fail() {
  printf 'corpus_test: %s\n' "$*" >&2
  cat "$out/files.csv" "$out/summary.md" >&2 || true
  exit 1
}

solid='v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n'
# shellcheck disable=SC2059
printf "$solid" >"$files/solid.obj"
printf 'v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n' >"$files/an open, one.obj"
cp "$files/solid.obj" "$files/crash.obj"
cp "$files/solid.obj" "$files/hang.obj"
# shellcheck disable=SC2059
printf "$solid" | gzip >"$files/packed.obj.gz"
echo text >"$files/readme.txt"

cat >"$work/cli" <<END
#!/usr/bin/env bash
echo "\$2" >>"$work/calls"
case \$2 in
  */crash.obj) kill -SEGV \$\$ ;;
  */hang.obj) sleep 60 ;;
  *) exec "$cli" "\$@" ;;
esac
END
chmod +x "$work/cli"
export PALPA_CLI=$work/cli

corpus() { "$root/scripts/corpus" "$files" --out "$out" --time 20 --options '--edge-length 2' "$@" >/dev/null 2>&1; }
has() { grep -q -- "$1" "$2" || fail "$2 lacks: $1"; }

corpus --random 2 --seed 2
[[ $(wc -l <"$work/calls") -eq 2 ]] || fail "two files were asked for"
cp "$work/calls" "$work/first"
rm -f "$work/calls"
corpus --random 2 --seed 2 --fresh
cmp -s "$work/first" "$work/calls" || fail "the same seed drew other files"
corpus --time 5
[[ $(sort "$work/calls" | uniq -d | wc -l) -eq 0 ]] || fail "a file was run twice"
[[ $(wc -l <"$work/calls") -eq 5 ]] || fail "not all five files were run"

has '/solid.obj","obj","touched","yes","mesh body",4,[0-9]*,' "$out/files.csv"
has '/packed.obj","obj","touched","yes"' "$out/files.csv"
has '/an open, one.obj","obj","refused","no",.*"3 open edges, the first between' "$out/files.csv"
has '/crash.obj","obj","crash","yes",.*"exit code 139' "$out/files.csv"
has '/hang.obj","obj","hang","yes",.*"no result after 5 s"' "$out/files.csv"
has '^file,.*,reason,force_error,processor_seconds$' "$out/files.csv"
has '/solid.obj",.*,"",[0-9.e-]*[0-9],[0-9.]*[0-9]$' "$out/files.csv"
has '^| processor time, median, 90 % | [0-9.]* s, [0-9.]* s |' "$out/summary.md"
has '^| of the force alone, median; at most 5 % | [0-9.]*; [0-9] of 2' "$out/summary.md"
has '^| touched, of these | 2 of 4 (50 %) |' "$out/summary.md"
has '^| crashes, hangs | 1, 1 |' "$out/summary.md"
has '^| refused: … open edges, the first between (…) mm and (…) mm; close the surface | no | 1 |' "$out/summary.md"
has '^| an open, one.obj |  |' "$out/files.md"
