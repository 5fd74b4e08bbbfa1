# Worst error against time, a panel per regime, a point per method.
#   title, subtitle, machine   texts
#   regime[]                   names of the six panels
#   legend[], legend_x[], …    a line each: text, place on the page, and of a method's line its marker, else 0
#   $points                    ns, worst error, 99.9 % error, energy-weighted error, marker, its size, colour,
#                              whether it
#                              fails; an index per panel
#   $lines                     ns, error, colour of the settings of a method, a gap between methods; an index
#                              per panel
set terminal svg size 1500,1120 enhanced font 'Helvetica,13' background '#ffffff'
set output picture
set multiplot
unset key
set logscale xy
set grid xtics ytics lc rgb '#e4e4e4' lw 0.6
set mxtics 1
set mytics 1
set xrange [1:2e7]
set yrange [1e-17:1e6]   # the band above 1 shows what fails
time_tics = \
    "('1 ns' 1, '10 ns' 10, '100 ns' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6, '10 ms' 1e7)"

set label title at screen 0.012,0.975 left front noenhanced font ',20' textcolor rgb '#000000'
set label subtitle at screen 0.012,0.945 left front noenhanced font ',13' textcolor rgb '#333333'
set label machine at screen 0.012,0.016 left front noenhanced font ',12' textcolor rgb '#555555'
do for [i=1:|legend|] {
    set label legend[i] at screen legend_x[i],legend_y[i] left front noenhanced \
        font (legend_marker[i] == 0 ? ',13' : ',12') \
            textcolor rgb (legend_marker[i] == 0 ? '#000000' : '#222222')
    if (legend_marker[i] != 0) {
        set label '' \
            at screen legend_x[i]-0.011,legend_y[i] point pt legend_marker[i] ps legend_size[i] lw 1.6 \
            lc rgb legend_colour[i]
    }
}
set label 'Marker: worst error; it grows with the bytes of the method''s tables. ' . \
    'Dot: 99.9 % of the points are better. Lower end of the line: error weighted by energy. ' . \
    'Joined: settings of one method.' \
    at screen 0.012,0.058 left front noenhanced font ',12' textcolor rgb '#333333'
set label 'Crossed, in the grey band: at some points no correct digit, 0, infinity or NaN. ' . \
    'Dashed: 7 % (0.3 dB), a typical distance of the model itself from exact scattering.' \
    at screen 0.012,0.039 left front noenhanced font ',12' textcolor rgb '#333333'

do for [i=0:|regime|-1] {
    left = 0.058 + 0.318 * (i % 3)
    bottom = i < 3 ? 0.615 : 0.275
    set lmargin at screen left
    set rmargin at screen left + 0.293
    set bmargin at screen bottom
    set tmargin at screen bottom + 0.285
    if (i < 3) { set xtics format '' 10 } else { set xtics format '' @time_tics }
    set format y (i % 3 == 0 ? '10^{%T}' : '')
    set ytics 1e-16,100,1
    set ylabel (i % 3 == 0 ? 'worst relative error' : '') offset 0.5,0
    set xlabel (i < 3 ? '' : 'time per value of Φ, one core')
    set title regime[i + 1] offset 0,-0.6 font ',15' noenhanced
    set object 1 rect from graph 0, first 1 to graph 1, graph 1 fc rgb '#f0f0f0' fs solid noborder behind
    set arrow 1 from graph 0, first 0.07 to graph 1, first 0.07 nohead lc rgb '#888888' lw 1 dt 2 back
    set label 'fails' at graph 0.985, graph 0.95 right textcolor rgb '#666666' font ',12'
    plot $points index i using 1:(column(4) < 1 ? $4 : 1):(0):($2 - (column(4) < 1 ? $4 : 1)):7 \
            with vectors nohead lw 0.8 lc rgb variable notitle, \
        $lines index i using 1:2:3 with lines lw 1.2 lc rgb variable notitle, \
        $points index i using 1:3:7 with points pt 7 ps 0.3 lc rgb variable notitle, \
        $points index i using 1:2:6:5:7 with points ps variable pt variable lc rgb variable lw 1.6 notitle, \
        $points index i using 1:($8 == 1 ? $2 : NaN) with points pt 2 ps 1 lw 1.2 lc rgb '#ffffff' notitle
    unset label
    unset object
}
unset multiplot
