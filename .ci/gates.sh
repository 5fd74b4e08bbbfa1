# Sourced by run and nightly beside it. A gate NAME is their function gate_NAME.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. ./run

# gates first|every NAME …: runs the gates in their order, until one fails or every one, then prints how long each took. 1 if one failed.
gates() {
    local until=$1 failed=0 table='' name began outcome
    shift
    SECONDS=0
    for name in "$@"; do
        printf '\n== %s\n' "$name"
        began=$SECONDS outcome=passed
        bash -euo pipefail -c ". '$script'; gate_$name" || { outcome=FAILED failed=1; }
        table+=$(printf '%-12s %8d s  %s' "$name" $((SECONDS - began)) "$outcome")$'\n'
        if [ $failed -eq 1 ] && [ "$until" = first ]; then break; fi
    done
    printf '\n%s%-12s %8d s\n' "$table" altogether "$SECONDS"
    return $failed
}
