#!/usr/bin/env bash
# Includes only go down:
#   base <- numeric, mesh <- {tissue, needle, coupling, force} <- sim <- io, net <- study, view, haptics <- acus.h <- apps
# and the four in braces are strangers to each other, like numeric and mesh, io and net, and study, view and haptics.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"

declare -A level=([base]=0 [numeric]=1 [mesh]=1 [tissue]=2 [needle]=2 [coupling]=2 [force]=2 [sim]=3 [io]=4 [net]=4 [study]=5
                  [view]=5 [haptics]=5 [acus.h]=6)
# The engine knows no threads, no clock, no sockets and no streams, and keeps to what libc++ 13 has.
outside='thread|mutex|shared_mutex|condition_variable|future|atomic|semaphore|barrier|latch|stop_token|chrono|ctime'
outside+='|time\.h|sys/time\.h|sys/socket\.h|netinet/.*|unistd\.h|iostream|istream|ostream|sstream|fstream|iomanip|locale|filesystem|random'
# But for the one file whose threads share a step.
team='src/acus/base/team.cpp:(thread|atomic)'
too_new='format|ranges|source_location'

# Lines of FILE that include something: "line:name", where name keeps its quote or angle bracket.
includes_of() { sed -n 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*\(["<][^">]*\)[">].*/\1/;T;=;p' "$1" | paste -d: - -; }

check_include() {  # FILE FOLDER LINE NAME
  local file=$1 folder=$2 line=$3 name=$4 target
  case $name in
    '"acus/acus.h') target=acus.h ;;
    '"acus/'*/*) target=${name#\"acus/} target=${target%%/*} ;;
    '"'*) violation "$file:$line" "write the whole path, #include \"acus/folder/file.h\", not ${name#\"}"; return ;;
    *)
      if [[ $file:${name#<} =~ ^$team$ ]]; then
        return
      elif [[ $folder != acus.h && ${level[$folder]} -le 3 && ${name#<} =~ ^($outside)$ ]]; then
        violation "$file:$line" "the engine knows no ${name#<}: threads, clocks, sockets and streams live above sim"
      elif [[ ${name#<} =~ ^($too_new)$ ]]; then
        violation "$file:$line" "libc++ 13 lacks all or part of <${name#<}>"
      fi
      return ;;
  esac
  if [[ -z ${level[$target]:-} ]]; then
    violation "$file:$line" "the folder $target has no place in the order of the folders"
  elif [[ $target != "$folder" && ${level[$target]} -ge ${level[$folder]} ]]; then
    violation "$file:$line" "$folder may not include $target: includes only go down"
  fi
}

while read -r file; do
  folder=${file#src/acus/} folder=${folder%%/*}
  if [[ -z ${level[$folder]:-} ]]; then
    violation "$file" "the folder $folder has no place in the order of the folders"
    continue
  fi
  while IFS=: read -r line name; do check_include "$file" "$folder" "$line" "$name"; done < <(includes_of "$file")
done < <(files src | grep -E '\.(cpp|h)$' || true)
verdict
