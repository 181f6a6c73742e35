//! Functions of optics beside their textbook forms.

use lobefit_truth::optics::{Smith, diffuse, footprint, fresnel, ggx, multiscatter};
use lobefit_truth::quantity::{eon, sheen};

use crate::Attack;
use crate::big::Big;

/// Smith's Lambda as it is printed (Heitz 2014, eq. 72).
fn lambda(alpha: &Big, mu: &Big) -> Big {
    let tan2 = (1.0 - mu.square()) / mu.square();
    ((1.0 + alpha.square() * tan2).sqrt() - 1.0) / 2.0
}

/// G2 of two Lambdas.
fn g2(smith: Smith, v: &Big, l: &Big) -> Big {
    match smith {
        Smith::Correlated => 1.0 / (1.0 + v + l),
        Smith::Separable => 1.0 / ((1.0 + v) * (1.0 + l)),
    }
}

/// The squared amplitudes of Fresnel for light in a medium of index 1, as they are printed.
fn dielectric(ior: &Big, c: &Big) -> Big {
    let c_t = (ior.square() - 1.0 + c.square()).sqrt() / ior;
    let of = |a: Big, b: Big| if (a + b).is_zero() { Big::from(0.0) } else { ((a - b) / (a + b)).square() };
    let (s, p) = (of(*c, ior * c_t), of(ior * c, c_t));
    (s + p) / 2.0
}

/// Those of a conductor at c > 0, with (a + i b)^2 = (eta + i k)^2 - sin^2.
fn conductor(eta: &Big, k: &Big, c: &Big) -> Big {
    let s2 = 1.0 - c.square();
    let real = eta.square() - k.square() - s2;
    let length = (real.square() + 4.0 * (eta * k).square()).sqrt();
    let [a, b] = [(length + real) / 2.0, (length - real) / 2.0].map(|x| x.max(0.0).sqrt());
    let of = |x: &Big| ((a - x).square() + b.square()) / ((a + x).square() + b.square());
    let s = of(c);
    (s + s * of(&(s2 / c))) / 2.0
}

/// F averaged over the hemisphere in closed form (Duntley 1942).
fn dielectric_average(n: &Big) -> Big {
    let (n2, one) = (n.square(), Big::from(1.0));
    let n4 = n2.square();
    let (plus, minus) = (&n2 + 1.0, &n4 - 1.0);
    0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0).square())
        + n2 * (&n2 - 1.0).square() / (plus.square() * plus) * ((n - 1.0) / (n + 1.0)).ln()
        - 2.0 * (n2 * n) * (n2 + 2.0 * n - 1.0) / (plus * minus)
        + 8.0 * &n4 * (n4 + one) / (plus * minus.square()) * n.ln()
}

/// A normal of Dupuy and Benyoub's spherical cap.
fn visible_normal(x: &[Big]) -> Vec<Big> {
    let [ax, ay, across, up, sine, cosine, part] = x else { unreachable!("seven inputs") };
    let unit = |a: [Big; 3]| {
        let length = (a[0].square() + a[1].square() + a[2].square()).sqrt();
        a.map(|x| x / length)
    };
    let wide = unit([ax * across, Big::from(0.0), *up]);
    let z = (1.0 - part) * (1.0 + &wide[2]) - wide[2];
    let ring = (1.0 - z.square()).max(0.0).sqrt();
    unit([ax * (ring * cosine + wide[0]), ay * (ring * sine), z + wide[2]]).to_vec()
}

/// A point of the unit circle, nearly: what rounding leaves of it goes into both sides.
fn circle(t: f64) -> [f64; 2] {
    [2.0 * t / (1.0 + t * t), (1.0 - t) * (1.0 + t) / (1.0 + t * t)]
}

fn of_fresnel(attacks: &mut Vec<Attack>) {
    let mut add = |name, ours: fn(&[f64]) -> Vec<f64>, exact: fn(&[Big]) -> Vec<Big>| {
        attacks.push(Attack::of(name, ours, exact));
    };
    add(
        "truth::optics::fresnel::schlick_weight",
        |x| vec![fresnel::schlick_weight(x[0])],
        |x| vec![x[0].fifth_power()],
    );
    add(
        "truth::optics::fresnel::f0_of_ior",
        |x| vec![fresnel::f0_of_ior(x[0])],
        |x| vec![((&x[0] - 1.0) / (&x[0] + 1.0)).square()],
    );
    add(
        "truth::optics::fresnel::schlick",
        |x| vec![fresnel::schlick(x[0], x[1])],
        |x| vec![x[0] + (1.0 - &x[0]) * x[1].fifth_power()],
    );
    add(
        "truth::optics::fresnel::schlick_average",
        |x| vec![fresnel::schlick_average(x[0])],
        |x| vec![x[0] + (1.0 - &x[0]) / 21.0],
    );
    add(
        "truth::optics::fresnel::dielectric",
        |x| vec![fresnel::dielectric(x[0], x[1])],
        |x| vec![dielectric(&x[0], &x[1])],
    );
    add(
        "truth::optics::fresnel::conductor",
        |x| vec![fresnel::conductor(x[0], x[1], x[2])],
        |x| vec![conductor(&x[0], &x[1], &x[2])],
    );
    add(
        "truth::optics::fresnel::f0_of_conductor",
        |x| vec![fresnel::f0_of_conductor(x[0], x[1])],
        |x| vec![conductor(&x[0], &x[1], &Big::from(1.0))],
    );
    attacks.push(Attack::of(
        "truth::optics::fresnel::dielectric_average",
        |x| vec![fresnel::dielectric_average(x[0])],
        |x| vec![dielectric_average(&x[0])],
    ));
}

fn of_ggx(attacks: &mut Vec<Attack>) {
    attacks.push(Attack::of(
        "truth::optics::ggx::stretched_length",
        |x| vec![ggx::stretched_length(x[0], x[1])],
        |x| vec![(x[1].square() + x[0].square() * (1.0 - x[1].square())).sqrt()],
    ));
    attacks.push(Attack::of(
        "truth::optics::ggx::lambda",
        |x| vec![ggx::lambda(x[0], x[1])],
        |x| vec![lambda(&x[0], &x[1])],
    ));
    attacks.push(Attack::of(
        "truth::optics::ggx::lambda_towards",
        |x| vec![ggx::lambda_towards([x[0], x[1]], [x[2], x[3], x[4]])],
        |x| {
            let across = (x[0] * x[2]).square() + (x[1] * x[3]).square();
            vec![((1.0 + across / x[4].square()).sqrt() - 1.0) / 2.0]
        },
    ));
    attacks.push(Attack::of(
        "truth::optics::ggx::distribution",
        |x| vec![ggx::distribution(x[0], [x[1], x[2], x[3]])],
        |x| {
            let a2 = x[0].square();
            let t = (x[1].square() + x[2].square()) / a2 + x[3].square();
            vec![1.0 / (Big::pi() * a2 * t.square())]
        },
    ));
    attacks.push(Attack::of(
        "truth::optics::ggx::visible_normal",
        |x| {
            let [[sine, cosine], view] = [circle(x[3]), circle(x[2])];
            ggx::visible_normal_at([x[0], x[1]], [view[0], 0.0, view[1]], (sine, cosine), x[4]).to_vec()
        },
        |x| {
            let [[sine, cosine], view] = [circle(x[3].to_f64()), circle(x[2].to_f64())];
            let [across, up, sine, cosine] = [view[0], view[1], sine, cosine].map(Big::from);
            visible_normal(&[x[0], x[1], across, up, sine, cosine, x[4]])
        },
    ));
    attacks.push(Attack::of(
        "truth::optics::ggx::mirror",
        |x| {
            let (light, cosine) = ggx::mirror([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
            vec![light[0], light[1], light[2], cosine]
        },
        |x| {
            let cosine = x[0] * x[3] + x[1] * x[4] + x[2] * x[5];
            let of = |k: usize| 2.0 * &cosine * x[k + 3] - x[k];
            vec![of(0), of(1), of(2), cosine]
        },
    ));
}

fn of_smith(attacks: &mut Vec<Attack>) {
    for smith in Smith::ALL {
        attacks.push(Attack::of(
            "truth::optics::smith::Smith::lit_given_visible",
            move |x| vec![smith.lit_given_visible(x[0], x[1])],
            move |x| vec![g2(smith, &x[0], &x[1]) * (1.0 + &x[0])],
        ));
        attacks.push(Attack::of(
            "truth::optics::smith::Smith::shadowed_given_visible",
            move |x| vec![smith.shadowed_given_visible(x[0], x[1])],
            move |x| vec![1.0 - g2(smith, &x[0], &x[1]) * (1.0 + &x[0])],
        ));
        attacks.push(Attack::of(
            "truth::optics::smith::Smith::shadowing_over_cosine",
            move |x| {
                let [s_v, s_l] = [x[1], x[2]].map(|mu| ggx::stretched_length(x[0], mu));
                vec![smith.shadowing_over_cosine(x[1], s_v, x[2], s_l)]
            },
            move |x| vec![g2(smith, &lambda(&x[0], &x[1]), &lambda(&x[0], &x[2])) / x[1]],
        ));
        attacks.push(Attack::of(
            "truth::optics::smith::Smith::shadowed_over_cosine",
            move |x| {
                let [s_v, s_l] = [x[1], x[2]].map(|mu| ggx::stretched_length(x[0], mu));
                let lift = x[0] * x[0] * (1.0 - x[2]) * (1.0 + x[2]) / (s_l + x[2]);
                vec![smith.shadowed_over_cosine(x[1], s_v, x[2], s_l, lift)]
            },
            move |x| {
                let [v, l] = [1, 2].map(|k| lambda(&x[0], &x[k]));
                vec![(1.0 / (1.0 + &v) - g2(smith, &v, &l)) / x[1]]
            },
        ));
        attacks.push(Attack::of(
            "truth::optics::ggx::lit_given_visible",
            move |x| vec![ggx::lit_given_visible(smith, x[0], x[1], x[2])],
            move |x| {
                let [v, l] = [1, 2].map(|k| lambda(&x[0], &x[k]));
                vec![g2(smith, &v, &l) * (1.0 + v)]
            },
        ));
        attacks.push(Attack::of(
            "truth::optics::ggx::visibility",
            move |x| {
                let [s_v, s_l] = [x[1], x[2]].map(|mu| ggx::stretched_length(x[0], mu));
                vec![ggx::visibility(smith, x[1], s_v, x[2], s_l)]
            },
            move |x| {
                let [v, l] = [1, 2].map(|k| lambda(&x[0], &x[k]));
                vec![g2(smith, &v, &l) / (4.0 * &x[1] * x[2])]
            },
        ));
    }
}

fn of_energy(attacks: &mut Vec<Attack>) {
    use multiscatter::Bounces::{FromFirst, FromSecond};
    attacks.push(Attack::of(
        "truth::optics::multiscatter::compensation",
        |x| vec![multiscatter::compensation(x[0], x[1], x[2])],
        |x| vec![1.0 + x[0] * x[2] / x[1]],
    ));
    attacks.push(Attack::of(
        "truth::optics::multiscatter::kulla_conty",
        |x| vec![multiscatter::kulla_conty(x[0], x[1], x[2])],
        |x| vec![if x[2].is_zero() { Big::from(0.0) } else { x[0] * x[1] / (Big::pi() * x[2]) }],
    ));
    for bounces in [FromFirst, FromSecond] {
        let series = move |f: &Big, lost: &Big| {
            let once = f * (1.0 - lost) / (1.0 - f * lost);
            if bounces == FromFirst { once } else { f * once }
        };
        attacks.push(Attack::of(
            "truth::optics::multiscatter::series",
            move |x| vec![multiscatter::series(bounces, x[0], 1.0 - x[1], x[1])],
            move |x| vec![series(&x[0], &x[1])],
        ));
        attacks.push(Attack::of(
            "truth::optics::multiscatter::absorbed",
            move |x| vec![multiscatter::absorbed(bounces, x[0], 1.0 - x[1], x[1])],
            move |x| vec![1.0 - series(&x[0], &x[1])],
        ));
    }
}

/// Schlick's weight of a cosine.
fn weight(mu: &Big) -> Big {
    (1.0 - mu).fifth_power()
}

fn of_diffuse(attacks: &mut Vec<Attack>) {
    attacks.push(Attack::of(
        "truth::optics::diffuse::ashikhmin_shirley",
        |x| vec![diffuse::ashikhmin_shirley(x[0], x[1], x[2])],
        |x| {
            let half = |mu: &Big| 1.0 - weight(&(mu / 2.0));
            vec![28.0 * (1.0 - &x[0]) * half(&x[1]) * half(&x[2]) / 23.0]
        },
    ));
    attacks.push(Attack::of(
        "truth::optics::diffuse::fresnel_product",
        |x| vec![diffuse::fresnel_product(x[0], x[1], x[2])],
        |x| vec![21.0 * (1.0 - &x[0]) * (1.0 - weight(&x[1])) * (1.0 - weight(&x[2])) / 20.0],
    ));
    attacks.push(Attack::of(
        "truth::optics::diffuse::schlick_roughness",
        |x| vec![diffuse::schlick_roughness(x[0], x[1], x[2])],
        |x| vec![1.0 - &x[0] - ((1.0 - &x[1]).max(x[0]) - x[0]) * weight(&x[2])],
    ));
    attacks.push(Attack::of(
        "truth::optics::diffuse::pesce",
        |x| vec![diffuse::pesce(x[0], x[1], x[2])],
        |x| vec![(1.0 - &x[1]) * (1.0 - &x[2]) + (1.0 - &x[0]) * x[2]],
    ));
    attacks.push(Attack::of(
        "truth::optics::diffuse::dassault",
        |x| vec![diffuse::dassault(x[0], x[1], x[2], x[3])],
        |x| {
            let smooth = (1.0 - &x[1]).fifth_power();
            let left = |mu: &Big| (1.0 - weight(mu)) * smooth + 0.95238 * (1.0 - &smooth);
            vec![(1.0 - &x[0]) * left(&x[2]) * left(&x[3]) / (1.0 + (0.33263 * &x[1] + 0.072359) * x[0])]
        },
    ));
    attacks.push(Attack::of(
        "truth::optics::diffuse::kelemen",
        |x| vec![diffuse::kelemen(x[0], x[1], x[2])],
        |x| vec![if x[2].is_zero() { Big::from(0.0) } else { x[0] * x[1] / x[2] }],
    ));
    attacks.push(Attack::of(
        "truth::optics::diffuse::interreflected",
        |x| vec![diffuse::interreflected(x[0], x[1], x[2], x[3])],
        |x| {
            let below = 1.0 - x[0] * (1.0 - &x[3]);
            vec![if below.is_zero() { Big::from(0.0) } else { x[1] * x[2] / below }]
        },
    ));
}

fn of_footprints(attacks: &mut Vec<Attack>) {
    let least = |x: &Big| (*x).max(footprint::LEAST_COSINE);
    attacks.push(Attack::of(
        "truth::optics::footprint::slant_ratio",
        |x| vec![footprint::slant_ratio([0.0, 0.0, 1.0], [0.0, 0.0, x[0]], [0.0, 0.0, x[1]])],
        move |x| vec![least(&x[1]) / least(&x[0])],
    ));
    attacks.push(Attack::of(
        "truth::optics::footprint::area_ratio",
        |x| {
            let up = [0.0, 0.0, 1.0];
            vec![footprint::area_ratio(up, ([0.0, 0.0, x[0]], x[2]), ([0.0, 0.0, x[1]], x[3]))]
        },
        move |x| vec![x[2] / x[3] * (least(&x[1]) / least(&x[0])).sqrt()],
    ));
    attacks.push(Attack::of(
        "truth::optics::footprint::width",
        |x| vec![footprint::width(x[0], x[1])],
        |x| {
            let wide = x[0] * x[1];
            vec![if wide.is_zero() { wide } else { wide / (1.0 + &x[0] - wide).max(wide) }]
        },
    ));
}

fn of_cloth(attacks: &mut Vec<Attack>) {
    attacks.push(Attack::of(
        "truth::quantity::sheen::lobe::exponent",
        |x| vec![sheen::lobe::exponent(x[0])],
        |x| vec![1.0 / &x[0]],
    ));
    attacks.push(Attack::of(
        "truth::quantity::sheen::lobe::distribution",
        |x| vec![sheen::lobe::distribution(x[0], [x[1], 0.0, 0.5])],
        |x| {
            let p = 1.0 / &x[0];
            vec![(2.0 + &p) * (p * x[1].ln()).exp() / (2.0 * Big::pi())]
        },
    ));
    attacks.push(Attack::of(
        "truth::quantity::sheen::lobe::lit",
        |x| vec![sheen::lobe::lit(x[0], x[1])],
        |x| vec![x[1] / (x[1] + x[0] - x[1] * x[0])],
    ));
}

/// L of a view at the roughness 1 by the sum over the azimuth (Portsmouth, Kutz and Hill 2024, eq. 13).
fn eon_loss(mu: &Big) -> Big {
    let (s, phi) = ((1.0 - mu.square()).sqrt(), mu.asin());
    let theta = Big::pi() / 2.0 - phi;
    // G = sin (theta - sin cos) + 2/3 (tan (1 - sin^3) - sin), of which E = 1/(1 + C r) (1 + r G/pi).
    let g = s * (theta - s * mu) + 2.0 * (s * (1.0 - s * s.square()) / mu - s) / 3.0;
    0.5 - 2.0 / (3.0 * Big::pi()) - g / Big::pi()
}

fn of_eon(attacks: &mut Vec<Attack>) {
    let face_on = || 0.5 - 2.0 / (3.0 * Big::pi());
    let swing = || 2.0 / Big::from(3.0) - 28.0 / (15.0 * Big::pi());
    attacks.push(Attack::of(
        "truth::quantity::eon::albedo",
        |x| eon::albedo(x[0], x[1]).to_vec(),
        move |x| {
            let loss = x[0] * eon_loss(&x[1]) / (1.0 + face_on() * x[0]);
            vec![1.0 - &loss, loss]
        },
    ));
    attacks.push(Attack::of(
        "truth::quantity::eon::average",
        |x| eon::average(x[0]).to_vec(),
        move |x| {
            let e = (1.0 + swing() * x[0]) / (1.0 + face_on() * x[0]);
            vec![e, 1.0 - e]
        },
    ));
    attacks.push(Attack::of(
        "truth::quantity::eon::lobe",
        |x| vec![eon::lobe(x[0], x[1], x[2], x[3])],
        move |x| {
            let s = x[3] - x[1] * x[2];
            let t = if s > Big::from(0.0) { x[1].max(x[2]) } else { Big::from(1.0) };
            vec![(1.0 + x[0] * s / t) / (Big::pi() * (1.0 + face_on() * x[0]))]
        },
    ));
}

/// All of them.
pub fn attacks() -> Vec<Attack> {
    let mut all = Vec::new();
    for of in [of_fresnel, of_ggx, of_smith, of_energy, of_diffuse, of_footprints, of_cloth, of_eon] {
        of(&mut all);
    }
    all
}
