// SPDX-License-Identifier: Apache-2.0
// The scripts that shells read. They know nothing of the program but how to ask it.
#include "completion.h"

#include <array>

namespace gnomon::app {
namespace {

// Readline breaks words at "=" and puts a candidate in the place of what follows the last of them.
constexpr std::string_view kBash = R"script(# bash completion of gnomon, made by `gnomon completion bash`
_gnomon() {
    local line=${COMP_LINE:0:COMP_POINT} head= has_files= item rest gap=$'\x1f'
    local -a typed=() found=()
    line=${line//\\ /$gap} # names of lights have blanks
    read -ra typed <<<"$line"
    [[ $line == *[[:space:]] ]] && typed+=("")
    typed=("${typed[@]//$gap/ }")
    local current=${typed[${#typed[@]} - 1]}
    [[ $COMP_WORDBREAKS == *=* && $current == *=* ]] && head=${current%"${current##*=}"}
    while IFS=$'\t' read -r item rest; do
        case $item in
            :nospace) compopt -o nospace 2>/dev/null ;;
            :files) has_files=$rest ;;
            *) found+=("${item#"$head"}") ;;
        esac
    done < <("${1/#\~/$HOME}" completion -- "${typed[@]:1}" 2>/dev/null)
    COMPREPLY=()
    if [[ -n $has_files ]]; then # then readline quotes
        compopt -o filenames 2>/dev/null
        COMPREPLY=("${found[@]}")
        local file
        while IFS= read -r file; do
            [[ -d $file || " $has_files " == *" ${file##*.} "* || " $has_files " == *" $(
                tr '[:upper:]' '[:lower:]' <<<"${file##*.}") "* ]] && COMPREPLY+=("$file")
        done < <(compgen -f -- "${current#"$head"}")
        return
    fi
    for item in "${found[@]}"; do
        [[ $item == *[!-A-Za-z0-9_=+,.:/@]* ]] && printf -v item %q "$item"
        COMPREPLY+=("$item")
    done
}
complete -F _gnomon gnomon
)script";

constexpr std::string_view kZsh = R"script(#compdef gnomon
# zsh completion of gnomon, made by `gnomon completion zsh`
_gnomon() {
    local -a typed found shown
    local row word text files suffix=' '
    typed=("${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}")
    for row in "${(@f)$("${(Q)words[1]}" completion -- "${typed[@]}" 2>/dev/null)}"; do
        word=${row%%$'\t'*}
        text=${row#*$'\t'}
        case $word in
            :nospace) suffix= ;;
            :files) files=$text ;;
            ?*)
                found+=("$word")
                shown+=("$word${text:+  -- $text}")
                ;;
        esac
    done
    (( ${#found} )) && compadd -S "$suffix" -l -d shown -a found
    if [[ -n $files ]]; then
        compset -P '--*='
        if [[ $files == / ]]; then
            _files -/
        else
            _files -g "*.(#i)(${files// /|})"
        fi
    fi
}
if [[ ${funcstack[1]} == _gnomon ]]; then
    _gnomon "$@"
else
    compdef _gnomon gnomon
fi
)script";

constexpr std::string_view kFish = R"script(# fish completion of gnomon, made by `gnomon completion fish`
function __gnomon_complete
    set -l typed (commandline -opc)
    set -l current (commandline -ct)
    for row in ($typed[1] completion -- $typed[2..] "$current" 2>/dev/null)
        set -l cells (string split \t -- $row)
        switch $cells[1]
            case :nospace
            case :files
                if test "$cells[2]" = /
                    __fish_complete_directories "$current"
                else
                    for extension in (string split ' ' -- $cells[2])
                        __fish_complete_suffix .$extension
                    end
                end
            case '*'
                printf '%s\n' $row
        end
    end
end
complete -c gnomon -f -a '(__gnomon_complete)'
)script";

constexpr std::array<std::string_view, 3> kShells{"bash", "zsh", "fish"};

} // namespace

std::span<const std::string_view> shellNames()
{
    return kShells;
}

std::string_view completionScript(std::string_view shell)
{
    return shell == kShells[0] ? kBash : shell == kShells[1] ? kZsh : kFish;
}

} // namespace gnomon::app
