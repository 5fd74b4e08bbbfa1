# Light reflected more than once, and what the model leaves out, against the slope.
#   theta_i[]   of the curves
#   $shares     slope, reflected more than once, 1 - the model's lobe; an index per angle of incidence
set terminal svg size 900,560 font 'Helvetica,14' background '#ffffff'
set output picture
set label 'Light reflected more than once, and what the model leaves out' \
    at screen 0.015,0.965 left noenhanced font ',19' tc rgb '#111111'
set label 'Perfect mirrors, rough limit. Dots: rays that leave after two or more reflections. Lines: 1 - ' . \
    'the model''s lobe.' \
    at screen 0.015,0.93 left noenhanced font ',13' tc rgb '#111111'
set margins 9,3,4,5
set xrange [0:1.05]
set yrange [0:1]
set xlabel 'σ_0/τ'
set ylabel 'share of the light'
set key bottom right Left reverse samplen 2
command = 'plot '
do for [i=1:|theta_i|] {
    colour = angle_colour(theta_i[i])
    command = command . (i == 1 ? '' : ', ') . \
        sprintf('$shares index %d using 1:2 with points pt 7 ps 0.9 lc rgb "%s" ', \
        i - 1, colour) . sprintf('title "θ_i = %.15g°", ', theta_i[i]) . \
        sprintf('$shares index %d using 1:3 with lines lw 2 lc rgb "%s" notitle', i - 1, colour)
}
eval command
