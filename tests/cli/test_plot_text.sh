#!/usr/bin/env bash
# Text of users in figures: whatever stands in titles, labels, names of columns and of files, the SVG is well-formed XML and shows
# the text; PNG and PDF are drawn too.
# Not sanitized: most of its time is gnuplot's, and cli/output draws under sanitizers.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
well_formed() { # well_formed FILE: what XML forbids in text and gnuplot does not mend; and all of it where there is a parser
    ! grep -qF ']]>' "$1" || fail "$2: ']]>' in a text"
    ! LC_ALL=C grep -qP '[\x00-\x08\x0b\x0c\x0e-\x1f]' "$1" || fail "$2: a control character"
    ! grep -qP '&(?!(amp|lt|gt|quot|apos|#[0-9]+|#x[0-9a-fA-F]+);)' "$1" || fail "$2: a bare &"
    ! command -v xmllint >/dev/null || xmllint --noout "$1" 2>err || fail "$2: $(head -3 err)"
}
texts=('a ]]> b' ']]]]>>' '<text>&amp;</text>' "it's \"x\" \\ %d @ {/Bold a}" $'esc \x1b[31m tab\tline\nend' $'\xef\xbf\xbf \xef\xbf\xbe \xe2\x80\xae \xc2\x9b'
    $'\xff\xfe broken' 'größe µm 😀' '<![CDATA[x]]>' '$(touch evil) `touch evil` '"'; system('touch evil') #")
for text in "${texts[@]}"; do
    printf 't,a,b\n0,1,3\n1,2,1\n2,4,2\n' >plain.csv
    run plot plain.csv plain.csv --columns a --title "$text" --label "$text" --label other -o a.svg -o a.png -o a.pdf
    expect_code 0 "a title and label '$text'"
    well_formed a.svg "a title and label '$text'"
    name=${text//[$',\n\r\t"/\x1b']/_}
    if printf '%s' "$name" | iconv -f UTF-8 -t UTF-8 >/dev/null 2>&1; then
        printf 't,%s,b\n0,1,3\n1,2,1\n2,4,2\n' "$name" >named.csv
        run plot named.csv --columns "$name,b" -o b.svg
        if ((code == 0)); then
            well_formed b.svg "a column '$text'"
        else
            expect_code 2 "a column '$text'"
        fi
    fi
    name=${text//[$'\n\/']/_}.csv
    cp plain.csv "./$name" 2>/dev/null || continue
    run plot "./$name" plain.csv --columns a -o c.svg
    expect_code 0 "a file '$text'"
    well_formed c.svg "a file '$text'"
done
[[ ! -e evil ]] || fail "text of a user was run"
"$GOUGH" plot plain.csv --columns a --title 'a ]]> b' -q -o t.svg
grep -q 'a \]\]&gt; b' t.svg || fail "the title is not shown: $(grep '<text>a' t.svg)"
finish
