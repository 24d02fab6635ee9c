# Completion of seiche's commands, options, keys and names for bash, and for zsh after bashcompinit. The program is asked
# for all of them.
_seiche_values() {  # of the key $1, as it stands in the list of keys
  seiche list keys --json 2>/dev/null | awk -v key="\"$1\"" '
    /^    "name"/ { is_asked = index($0, key) > 0 }
    is_asked && /^      "/ { gsub(/[ ",]/, ""); print }'
}

_seiche() {
  local line=${COMP_LINE:0:COMP_POINT} command=${COMP_WORDS[1]} words="" key=""
  local word=${line##*[[:space:]]} options=${line% *}
  options=${options##* -}
  if ((COMP_CWORD == 1)); then
    words="$(seiche --help 2>/dev/null | sed -nE 's/^  ([a-z]+) .*/\1/p') --help --version"
  elif [[ $word == -* ]]; then
    words=$(seiche "$command" --help 2>/dev/null | grep -oE -- '--[a-z-]+')
  elif [[ $command == new ]]; then
    words=$(seiche list problems --json 2>/dev/null | sed -nE 's/^    "name": "(.*)",?$/\1/p')
  elif [[ $command == list ]]; then
    words="methods problems backends keys"
  elif [[ " -$options" == " --methods"* ]]; then
    words=$(_seiche_values method.name | grep -v auto)
  elif [[ " -$options" == " --set"* && $word == *=* ]]; then
    key=${word%%=*}
    words=$(_seiche_values "$key")
    word=${word#*=}
    [[ $COMP_WORDBREAKS == *=* ]] || words=$(sed "s/^/$key=/" <<<"$words") word=$key=$word
  elif [[ " -$options" == " --set"* ]]; then
    words=$(seiche list keys 2>/dev/null | sed -nE 's/^([a-z_]+\.[A-Za-z_]+) .*/\1=/p')
    compopt -o nospace 2>/dev/null
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -o default -- "$word")  # case files, folders of runs
  fi
}
complete -F _seiche seiche
