#!/usr/bin/env bash
# Whether what a contributor is told is there: the files of the door themselves, and of the commands in pages, templates and workflows the files,
# presets, labels and suites of ctest.  And whether the site has all pages.  Commands are what stands in code of pages, and all of a YAML file.
# Usage: tests/structure/door.sh CTEST BUILD_FOLDER [PAGE...]; PAGE: one to look at in place of all.
set -euo pipefail
ctest=$1 build=$(realpath "$2")
shift 2
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
faults=0
fault() {
    echo "$1"
    ((++faults))
}

pages=("$@")
if (($# == 0)); then
    templates=(.github/ISSUE_TEMPLATE/{bug,question,wrong_number}.yml .github/pull_request_template.md)
    pages=(CONTRIBUTING.md SECURITY.md ARCHITECTURE.md RELEASING.md tests/README.md "${templates[@]}" .github/workflows/ci.yml .readthedocs.yaml)
    for file in "${pages[@]}" .pre-commit-config.yaml CITATION.cff; do
        [[ -s $file ]] || fault "there is no $file"
    done
    for page in README.md docs/README.md; do
        grep -q '(\(\.\./\)\?CONTRIBUTING\.md)' "$page" || fault "$page does not link to CONTRIBUTING.md"
    done
    for page in docs/*/*.md; do
        grep -q ": ${page#docs/}\$" scripts/site/mkdocs.yml || fault "the site, scripts/site/mkdocs.yml, does not list $page"
    done
    grep -q ' \.ci/run$' .github/workflows/ci.yml || fault "the workflow does not run .ci/run"
    (($(wc -w <CONTRIBUTING.md) <= 700)) || fault "CONTRIBUTING.md has more than 700 words"
fi

# What is in code: lines of fenced blocks, and spans, those of one line.
code_of() {
    case $1 in
        *.md) awk '/^ *```/ { fenced = !fenced; next }
                   fenced { print; next }
                   { while (match($0, /`[^`]+`/)) { print substr($0, RSTART + 1, RLENGTH - 2); $0 = substr($0, RSTART + RLENGTH) } }' "$1" ;;
        *) cat "$1" ;;
    esac
}
# values_of CODE OPTION: what follows an option, without quotes.
values_of() {
    grep -oE -- "(^| )$2 ('[^']+'|[^' ]+)" <<<"$1" | sed -E "s/^ ?$2 //; s/'//g" | sort -u || true
}
declare -A tests=()  # how many ctest has, by option and value
for page in "${pages[@]}"; do
    [[ -s $page ]] || continue
    code=$(code_of "$page")
    for path in $(grep -oE '(^|[ "`(])(\.ci|\.github|bench|cmake|docs|examples|host|kernels|python|scenes|scripts|tests)/[A-Za-z0-9_./-]*' <<<"$code" | tr -d ' "`(' | sort -u); do
        [[ -e ${path%.} ]] || fault "$page: there is no $path"
    done
    for program in $(grep -oE '\bbuild/release/bin/[a-z_]+' <<<"$code" | sort -u); do
        [[ -x $build/bin/${program##*/} ]] || fault "$page: there is no $program"
    done
    for preset in $(values_of "$code" --preset); do
        grep -q "\"name\": \"$preset\"" CMakePresets.json || fault "$page: there is no preset $preset"
    done
    for option in -L -R; do
        while read -r value; do
            [[ -n $value ]] || continue
            [[ -n ${tests["$option $value"]:-} ]] || tests["$option $value"]=$("$ctest" --test-dir "$build" -N "$option" "$value" | sed -n 's/^Total Tests: //p')
            [[ ${tests["$option $value"]} != 0 ]] || fault "$page: ctest has nothing for $option $value"
        done < <(values_of "$code" "$option")
    done
done
echo "${#pages[@]} files, $faults faults"
((faults == 0))
