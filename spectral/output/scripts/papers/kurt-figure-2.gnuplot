# Albedo of the symmetric form (9) of Kurt et al. 2010.
#   curve[]   names of the columns after the first
set margins 9,17,4,5
set label 'Albedo of the symmetric form (9), after Fig. 2 of Kurt et al. 2010' \
    at screen 0.02,0.955 left noenhanced font ',18' tc rgb '#111111'
set label 'F = 1. A curve per width m of the slopes.' \
    at screen 0.02,0.905 left noenhanced font ',13' tc rgb '#111111'
set xlabel 'angle of incidence [°]'
set xrange [0:90]
set xtics 15
set ytics 0.25
set yrange [0:1.1]
set ylabel 'albedo'
set key at graph 1.02,0.95 left top reverse Left
# the reflectance that no passive surface exceeds
set arrow from graph 0, first 1 to graph 1, first 1 nohead dt 2 lc rgb '#888888'
colours = '#0072b2 #56b4e9 #009e73 #e69f00 #d55e00 #aa4499'
plot for [i=1:|curve|] 'figure-2.csv' using 1:i+1 every ::1 with lines lw 2.4 lc rgb word(colours, i) \
    title curve[i]
