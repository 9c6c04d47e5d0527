#!/usr/bin/env bash
# The core neither allocates nor prints, opens, exits or asks the time: its objects need no such symbol. The
# libraries show only names that begin with gough_.
set -euo pipefail
: "${BUILD:?}"
failed=0
archive=$BUILD/libgough.a
[[ -e $archive ]] || { echo "$archive is missing"; exit 1; }
allowed=' memcmp memcpy memmove memset strchr strcmp strcpy strlen strncmp strrchr snprintf vsnprintf abort __assert_fail '
while read -r symbol; do
    case $symbol in
        malloc | calloc | realloc | free | aligned_alloc | strdup | *printf | *printf_chk | puts | putchar | fput* | fopen* | open | read | write | \
            exit | _exit | time | clock* | gettimeofday | getenv | setlocale | localeconv | rand* | srand)
            [[ $allowed == *" $symbol "* || $symbol == __*snprintf_chk ]] || { echo "libgough.a needs $symbol"; failed=1; } ;;
        pthread_create | pthread_join | pthread_attr_* | pthread_mutex_*) ;; # a batch starts its threads and waits for them
        pthread_*) echo "libgough.a needs $symbol"; failed=1 ;;
    esac
done < <(nm -u "$archive" | awk 'NF == 2 { print $2 }' | sort -u)
# tables of addresses are constant too, but for the loader: .data.rel.ro
writable=$(nm -f sysv "$archive" | awk -F'|' '$NF ~ /^ *(\.data|\.bss|\*COM\*|COMMON)/ && $NF !~ /\.data\.rel\.ro/ { print $1 }' | sort -u)
[[ -z $writable ]] || { echo "libgough.a has variables:" $writable; failed=1; }
foreign=$(nm -g --defined-only "$archive" | awk 'NF == 3 && $3 !~ /^gough_/ { print $3 }')
[[ -z $foreign ]] || { echo "libgough.a shows" $foreign; failed=1; }
for library in "$BUILD"/libgough.so "$BUILD"/libgough-analyse.so "$BUILD"/libgough-files.so; do
    [[ -e $library ]] || { echo "$library is missing"; failed=1; continue; }
    foreign=$(nm -D --defined-only "$library" | awk '$3 !~ /^gough_/ { print $3 }')
    [[ -z $foreign ]] || { echo "$(basename "$library") shows" $foreign; failed=1; }
done
exit $failed
