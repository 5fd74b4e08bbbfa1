# Every method against exact scattering: error in dB against time, a panel per kind of surface.
#   surface[]                    of the panels, whose numbers are in truth-1.csv, truth-2.csv …
#   count[], mark[]              rows of each panel, and their methods, panel after panel
#   model[], colour[], shape[]   of the methods
#   machine                      text
set terminal svg size 1200,960 font 'Helvetica,14' background '#ffffff'
set output picture
set multiplot
set logscale xy
most(v) = v < 18 ? v : 18
set yrange [0.05:20]
set xrange [25:9000]
set ytics ('0.1' 0.1, '0.2' 0.2, '0.5' 0.5, '1' 1, '2' 2, '5' 5, '10' 10)
unset key
set label 'How far from exact scattering, and how long it takes' \
    at screen 0.03,0.965 left noenhanced font ',18' tc rgb '#111111'
set label 'Perfect conductors, profiles. Bars: unpolarised light, from the median case to the worst; mark at the ' . \
    'median. Small: medians in TE (up) and TM (down).' \
    at screen 0.03,0.935 left noenhanced font ',13' tc rgb '#111111'
set label 'Joined marks: the same model at tolerance 1e-3, 1e-6 and 1e-12 of its arithmetic. Microfacets with the width ' . \
    'that fits best. On the upper edge: 18 dB and more.' \
    at screen 0.03,0.91 left noenhanced font ',13' tc rgb '#111111'
set label machine at screen 0.03,0.02 left noenhanced font ',11' tc rgb '#111111'

before = 0
do for [i=0:|surface|-1] {
    left = i % 2 == 0 ? 0.07 : 0.45
    bottom = i < 2 ? 0.53 : 0.1
    set lmargin at screen left
    set rmargin at screen left + 0.33
    set bmargin at screen bottom
    set tmargin at screen bottom + 0.32
    set title surface[i + 1] noenhanced
    if (i < 2) { unset xlabel } else { set xlabel 'time of four wavelengths, one pair [ns]' }
    if (i % 2 == 0) { set ylabel 'error against exact [dB]' } else { unset ylabel }
    data = sprintf('truth-%d.csv', i + 1)
    command = 'plot '
    do for [k=1:count[i + 1]] {
        row = sprintf('"%s" every ::%d::%d using 3:', data, k, k)
        m = mark[before + k]
        command = command . (k == 1 ? '' : ', ') . row . \
            sprintf('(most($6)):(0):(most($9)-most($6)) with vectors nohead lw 1.5 lc rgb "%s" notitle, ', colour[m]) . row . \
            sprintf('(most($4)) with points pt 8 ps 0.7 lc rgb "%s" notitle, ', colour[m]) . row . \
            sprintf('(most($5)) with points pt 10 ps 0.7 lc rgb "%s" notitle, ', colour[m]) . row . \
            sprintf('(most($6)) with points pt %d ps 1.1 lc rgb "%s" notitle', shape[m], colour[m])
        if (k > 1 && mark[before + k] == mark[before + k - 1]) {
            command = command . sprintf(', "%s" every ::%d::%d using 3:(most($6)) with lines lw 1 lc rgb "%s" notitle', \
                data, k - 1, k, colour[m])
        }
    }
    eval command
    before = before + count[i + 1]
    if (i == 0) { unset label }
}

# The methods and their marks, in a column of their own
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
set key at graph 0,1 left top reverse Left spacing 1.25 samplen 1 noenhanced
plot for [i=1:|model|] NaN with points ps 1.1 lc rgb colour[i] pt shape[i] title model[i], \
    NaN with points pt 8 ps 0.7 lc rgb '#333333' title 'TE', \
    NaN with points pt 10 ps 0.7 lc rgb '#333333' title 'TM'
unset multiplot
