# Time against g, a line per method.
#   title, subtitle, machine                   texts
#   legend[], legend_x[], …                    as in error-against-time.gnuplot
#   marker[], marker_size[], width[], ink[]    of the methods' lines
#   $times                                     g, ns, whether some value has no correct digit; an index per
#                                              method
set terminal svg size 1250,950 enhanced font 'Helvetica,13' background '#ffffff'
set output picture
set multiplot
unset key
set label title at screen 0.012,0.97 left front noenhanced font ',20' textcolor rgb '#000000'
set label subtitle at screen 0.012,0.94 left front noenhanced font ',13' textcolor rgb '#333333'
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
set lmargin at screen 0.075
set rmargin at screen 0.755
set bmargin at screen 0.115
set tmargin at screen 0.905
set logscale xy
set grid xtics ytics lc rgb '#e4e4e4' lw 0.6
set xrange [1e-3:1e8]
set yrange [1:1e9]
set ytics ('1 ns' 1, '10 ns' 10, '100 ns' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6, \
    '10 ms' 1e7, '100 ms' 1e8, '1 s' 1e9)
set xtics format '10^{%T}' 10
set mxtics 1
set mytics 1
set xlabel 'phase variance g (t/g uniform in 0 … 10)'
set ylabel 'time per value, one core'

# Dotted and solid of one method after the other, so that later methods lie on top
command = 'plot '
do for [i=1:|marker|] {
    data = sprintf('$times index %d ', i - 1)
    colour = sprintf('lc rgb "%s" notitle', ink[i])
    style = sprintf('pt %d ps %.15g lw %.15g ', marker[i], marker_size[i], width[i])
    command = command . (i == 1 ? '' : ', ') . data . 'with lines dt 3 lw 1 ' . colour . ', ' . \
        data . 'using 1:($3 == 1 ? NaN : $2) with linespoints pi 2 ' . style . colour
}
eval command
unset multiplot
