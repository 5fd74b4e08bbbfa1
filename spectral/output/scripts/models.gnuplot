# Every model against He-Torrance: error against time, a panel per surface.
#   surface[]                    of the panels, whose numbers are in models-1.csv, models-2.csv …
#   count[], mark[]              rows of each panel, and their marks, panel after panel
#   model[], colour[], shape[]   of the marks
#   machine                      text
size(bytes) = 0.9 + (bytes > 1000 ? 0.35 * log10(bytes / 1000.) : 0)
least(v) = v > 2e-8 ? v : 2e-8
set terminal svg size 1200,960 font 'Helvetica,14' background '#ffffff'
set output picture
set multiplot
set logscale xy
set format y '10^{%L}'
set yrange [2e-8:60]
set xrange [5:400]
unset key
set label 'What a cheaper model costs in accuracy, with He-Torrance as the truth' \
    at screen 0.03,0.965 left noenhanced font ',18' tc rgb '#111111'
set label 'Every other model is fitted to it on each surface, optical constants given; the tables are of ' . \
    'it.' \
    at screen 0.03,0.935 left noenhanced font ',13' tc rgb '#111111'
set label 'Error: |f - f_he| / (f_he + peak/100) over random pairs up to 80 deg, at 0.46, 0.54, 0.62 and ' . \
    '0.70 um.' \
    at screen 0.03,0.91 left noenhanced font ',13' tc rgb '#111111'
set label machine at screen 0.03,0.02 left noenhanced font ',12' tc rgb '#111111'

before = 0

# A bar from the median to the 99 % error of each model, with the mark at its upper end
do for [i=0:|surface|-1] {
    left = i % 2 == 0 ? 0.07 : 0.45
    bottom = i < 2 ? 0.53 : 0.1
    set lmargin at screen left
    set rmargin at screen left + 0.33
    set bmargin at screen bottom
    set tmargin at screen bottom + 0.32
    set title surface[i + 1] noenhanced
    if (i < 2) { unset xlabel } else { set xlabel 'time of four wavelengths, one pair [ns]' }
    if (i % 2 == 0) { set ylabel 'error, median to 99 %' } else { unset ylabel }
    data = sprintf('models-%d.csv', i + 1)
    command = 'plot '
    do for [k=1:count[i + 1]] {
        row = sprintf('"%s" every ::%d::%d using 2:', data, k, k)
        m = mark[before + k]
        command = command . (k == 1 ? '' : ', ') . row . \
            sprintf('(least($3)):(0):($4-least($3)) with vectors nohead lw 1.5 lc rgb "%s" notitle, ', \
                colour[m]) . row . \
            sprintf('(least($4)):(size($5)) with points ps variable lc rgb "%s" pt %d notitle', colour[m], \
                shape[m])
    }
    eval command
    before = before + count[i + 1]
    if (i == 0) { unset label }
}

# The marks and their names, in a column of its own, and below them what their sizes mean
unset border
unset tics
unset grid
unset xlabel
unset ylabel
unset title
unset logscale
set lmargin at screen 0.81
set rmargin at screen 0.99
set bmargin at screen 0.2
set tmargin at screen 0.86
set xrange [0:1]
set yrange [0:1]
set key at graph 0,1 left top reverse Left spacing 1.25 samplen 1
plot for [i=1:|model|] NaN with points ps 1.1 lc rgb colour[i] pt shape[i] title model[i], \
    NaN with points pt 7 lc rgb '#999999' ps size(1e3) title 'no table, or 1 kB', \
    NaN with points pt 7 lc rgb '#999999' ps size(1e5) title 'tables of 100 kB', \
    NaN with points pt 7 lc rgb '#999999' ps size(1e7) title 'of 10 MB'
unset multiplot
