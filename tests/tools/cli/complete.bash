# complete.bash SCRIPT WORD...: prints what the completion script offers for the last word, one on a line.
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_castor
printf '%s\n' "${COMPREPLY[@]}"
