# Measured dots and the model, a panel per curve, logarithmic.
#   surface, model, legend       texts
#   across, upwards              what the axes are
#   points, lines                CSV files, with the number of the curve in column 1
#   uncertain                    1: bars of the uncertainty
#   scattered[]                  of the panels, 1: pairs at the tilt of their facets, the model as crosses
#   panel[], least[], most[]     their titles, and powers of ten around what was measured
columns = |panel| == 1 ? 1 : int(ceil(sqrt(1.3 * |panel|)))
rows = (|panel| + columns - 1) / columns
pixels = |panel| == 1 ? 600. : 130 + 210. * rows
set terminal svg size 1000,int(pixels) font 'Helvetica,15' background '#ffffff'
set output picture
set label surface at screen 0.03,1-22/pixels left noenhanced font ',17' tc rgb '#111111'
set label model at screen 0.03,1-48/pixels left noenhanced font ',12' tc rgb '#111111'
set label legend at screen 0.03,18/pixels left noenhanced font ',12' tc rgb '#111111'
set multiplot
set logscale y
set format y '1e%T'
set xtics 30
unset mytics
set tics font ',12'
set bmargin 3
set tmargin 1.5
set lmargin 6.5
set rmargin 1
width = 0.97 / columns
height = (1 - 115 / pixels) / rows
x(c, i, swept, tilt) = c == i ? (scattered[i + 1] ? tilt : swept) : NaN
do for [i=0:|panel|-1] {
    set size six(width),six(height)
    set origin six(0.015 + width * (i % columns)),six(1 - 70 / pixels - height * (i / columns + 1))
    set xlabel (i + columns >= |panel| ? across : '') noenhanced font ',12' offset 0,0.7
    set ylabel (i % columns == 0 ? upwards : '') noenhanced font ',12' offset 1.6,0
    set title panel[i + 1] offset 0,-0.7 font ',12'
    set yrange [10.**least[i + 1]:10.**most[i + 1]]
    # bars and dots apart: gnuplot's own error bars wipe out what lies about each dot
    at = 'points every ::1 using (x($1, i, $3, $4)):'
    model_line = 'lines every ::1 using ($1 == i ? $3 : NaN):4 with lines '
    bars = '($5 > $6 ? $5 - $6 : $5 / 100):(0):($5 > $6 ? 2*$6 : $5 + $6) with vectors nohead lw 0.8 '
    crosses = at . '7 with points pt 2 ps 0.6 '
    eval 'plot ' . (scattered[i + 1] ? crosses : model_line) . 'lw 2.2 lc rgb "#0072b2" notitle, ' . \
        (uncertain ? at . bars . 'lc rgb "#999999" notitle, ' : '') . \
        at . '5 with points pt 7 ps ' . (scattered[i + 1] ? '0.6' : '0.34') . ' lw 0.7 lc rgb "#444444" notitle'
    unset label
}
unset multiplot
