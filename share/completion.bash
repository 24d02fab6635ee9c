# Completion of seiche's commands, options and names for bash, and for zsh after bashcompinit. The program is asked for
# all of them.
_seiche() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=""
  local names='s/^ *"name": "(.*)",?$/\1/p'
  if ((COMP_CWORD == 1)); then
    words="$(seiche --help 2>/dev/null | sed -nE 's/^  ([a-z]+) .*/\1/p') --help --version"
  elif [[ $word == -* ]]; then
    words=$(seiche "$command" --help 2>/dev/null | grep -oE -- '--[a-z-]+')
  elif [[ $command == new ]]; then
    words=$(seiche list problems --json 2>/dev/null | sed -nE 's/^    "name": "(.*)",?$/\1/p')
  elif [[ $command == list ]]; then
    words="methods problems backends"
  elif [[ $before == --methods || $word == method.name=* ]]; then
    words=$(seiche list methods --json 2>/dev/null | sed -nE "$names")
    [[ $word != method.name=* ]] || words=$(sed 's/^/method.name=/' <<<"$words")
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -o default -- "$word")  # case files, folders of runs
  fi
}
complete -o filenames -F _seiche seiche
