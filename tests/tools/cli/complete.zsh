# complete.zsh SCRIPT LINE: types the line into an interactive zsh with the completion script, and prints what
# that lists. Names of files are listed as they are.
setopt extended_glob
zmodload zsh/zpty zsh/datetime zsh/zselect
zpty -b shell zsh -f -i

# Reads what the shell has written until the text is there.
expect() {
  local end=$((EPOCHREALTIME + 20)) part
  while [[ $output != *"$1"* ]]; do
    while zpty -r -t shell part; do output+=$part; done
    if ((EPOCHREALTIME > end)); then
      print -u2 "zsh does not write $1, but: $output"
      exit 1
    fi
    zselect -t 5
  done
}

output=
zpty -w shell "PS1= PS2=; stty cols 200 rows 1000 -echo; autoload -Uz compinit; compinit -D -u; unsetopt zle_bracketed_paste
zstyle ':completion:*' list-grouped false; LISTMAX=10000; zstyle ':completion:*' menu no
castor-end() { zle -I; print -r -- end-of-choices; }
zle -N castor-end; bindkey '^T' list-choices '^Y' castor-end
source ${(q)1} && print -r -- \"ready \$((1 + 1))\""
expect 'ready 2'
output=
zpty -n -w shell "$2"$'\C-t\C-y'
expect 'end-of-choices'
zpty -d shell
# Without the terminal's control sequences, and what was typed.
print -r -- "${${output//$'\e'\[[0-9;?]#[a-zA-Z]/}%%end-of-choices*}" | tr -d '\r'
