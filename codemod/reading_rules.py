"""Readings → interpretations and choices, in what choices declared in paper.toml leave of them."""
from engine import *
from glossary_rules import rename_words, words_of, subs, each_text, RUST

PROSE = subs([
    (r'\bclock readings\b', 'times'), (r'\bClock readings\b', 'Times'), (r'\bclock reading\b', 'time'), (r'\bStored readings stay\b', 'Stored times stay'),
    (r'\bwhich reading of the clock in its session\b', 'which repeat of the timing in its session'),
    (r'\bthe repeated readings of the clock\b', 'the repeated times'), (r'\b([Aa]) reading of the clock\b', r'\1 time'), (r'\breadings of the clock\b', 'times'),
    (r'\breadings of different sessions\b', 'times of different sessions'), (r'\bits readings replace all older ones\b', 'its times replace all older ones'),
    (r'\b([Nn])o reading moves\b', r'\1o choice moves'), (r'\bwhich reading moves\b', 'which choice moves'), (r'\b[Nn]o explored reading moves\b', 'No explored choice moves'),
    (r'\b([Oo])ptions? of (a|other|each|every|another) readings?\b', lambda m: m.group().replace('readings', 'choices').replace('reading', 'choice')),
    (r'\bThe option of each reading\b', 'The option of each choice'), (r'\boption taken of (each|the) reading\b', r'option taken of \1 choice'), (r'\bdefaults of each reading\b', 'defaults of each choice'),
    (r'\b(settings?) of the readings\b', r'\1 of the choices'), (r'\b(the|other) readings that are not fitted\b', r'\1 choices that are not fitted'), (r'\bfitted reading\b', 'fitted choice'),
    (r'\breadings? that touch(es)? trials\b', lambda m: m.group().replace('readings', 'choices').replace('reading', 'choice')), (r'\bother readings touch trials\b', 'other choices touch trials'),
    (r'\ba reading or a sweep\b', 'an option or a sweep'), (r'\b[Ww]hat each reading( of a paper)? does\b', lambda m: m.group().replace('reading', 'choice')), (r'\bEvery reading that is kept\b', 'Every choice that is kept'),
    (r"\bthe readings' own\b", "the choices' own"), (r'\bsweeps, readings and figures\b', 'sweeps and figures'), (r'\bmost readings change\b', 'most options change'), (r'\b`?readings`? has \{\} options for \{\} axes', '`interpretations` has {} options for {} choices'),
    (r'\bwhose readings were not explored\b', 'that was not explored'), (r'\bThe readings were not explored\b', 'The choices were not explored'), (r'\breadings of problems\b', 'options of problems'),
    (r'\bstudies have no readings\b', 'studies have no choices'), (r'\bExploring a paper\'s readings\b', "Exploring a paper's choices"), (r"\b([Ee]xplor\w+ a paper's) readings\b", r'\1 choices'), (r'\bof its readings\b', 'of its interpretations'),
    (r'\bother readings than the defaults?\b', 'other interpretations than the default'), (r'\b[Nn]o other reading than\b', 'no other interpretation than'),
    (r'\b(the )?default readings\b', r'\1default interpretation'), (r'\bunder some readings\b', 'under some interpretations'),
    (r'\b([Aa]) (new |voting |fitted |silly |second )?reading\b(?! (the|and|an?|its|or|of|from|fails|panics)\b)', lambda m: ('An' if m.group(1) == 'A' else 'an') + ' interpretation' if not m.group(2) else m.group(1) + ' ' + m.group(2) + 'interpretation'),
    (r'(?<!["\w`-])readings\b(?!\.(rs|js|toml|parquet|manifest)|/)', 'interpretations'), (r'(?<!["\w`-])Readings\b', 'Interpretations'),
    (r'(?<!["\w`-])reading\b(?= (that|under|with|at|is|was|it|which|they|where|gives|on|by|itself|in|for|takes|\{)\b)', 'interpretation'),
    (r"\b((?:the|one|each|every|no|this|that|any|some|other|another|default|voting|same|first|further|paper's own|evidence's|compatible|of|under|whatever the|Under any|chosen|across|which) )reading\b(?! (the|and|an?|its|or|panics)\b)", r'\1interpretation'),
    (r'\b(The|One|Each|Every|No|This|Some) reading\b', r'\1 interpretation'), (r'"Reading: ', '"Interpretation: '), (r'\bReading (?=\d|\{)', 'Interpretation '),
    (r'<th>reading</th>', '<th>choice</th>'), (r'\ba reading"', 'an interpretation"'), (r'"reading", "readings"', '"interpretation", "interpretations"'),
    (r'\bmatter of reading\b', 'matter of interpretation'), (r'#reading\b', '#interpretation'), (r'\bid=(\\?")reading', r'id=\1interpretation'), (r'#readings\b', '#interpretations'), (r'\breading=', 'interpretation='),
    (r'\b\[\[round\.readings\]\]', '[[round.interpretations]]'), (r'"reading_', '"choice_'), (r'\breading_corners\b', 'choice_corners'), (r'"study,reading,', '"study,interpretation,'), (r'"study,reading"', '"study,interpretation"'),
    (r'\{readings\}', '{interpretations}'), (r'class=(\\?")readings', r'class=\1interpretations'), (r'"reading: ', '"interpretation: '), (r'; reading \{', '; interpretation {'), (r'\bround\.readings\b', 'round.interpretations'),
    (r'\ban interpretations\b', 'interpretations'), (r'"readings", "Readings"', '"interpretations", "Interpretations"'), (r'"Readings", "readings"', '"Interpretations", "interpretations"'), (r'\("readings", (?="readings"|judged)', '("interpretations", '), (r'^"readings"$', '"interpretations"'),
    (r'^"reading"$', '"interpretation"'), (r'^"reading \{\}"$', '"interpretation {}"'), (r'^"readings that turn', '"interpretations that turn'), (r'\bWhich reading\b', 'Which interpretation'), (r'\bwhich reading the paper\b', 'which interpretation the paper'),
    (r'\bthe default reading and under\b', 'the default interpretation and under'), (r'\bunder one reading and one\b', 'under one interpretation and one'), (r'\bby reading, (?=group|problem)', 'by interpretation, '), (r'\bthese options, by reading\b', 'these options, by choice'),
    (r'`readings`(?! is now)', '`interpretations`'), (r'\bWhich reading of the clock\b', 'Which repeat of the timing'), (r'\bof the reading and the problem group\b', 'of the interpretation and the problem group'), (r'\bunder every reading and\b', 'under every interpretation and'),
    (r'"Reading "', '"Interpretation "'), (r'-reading-(?=1280|390)', '-interpretation-'),
])
AXIS_PROSE = subs([(r"\b([Aa])n axis\b", r'\1 choice'), (r'\baxis\b', 'choice'), (r'\baxes\b', 'choices')])

NOT = ['!src/audit/**', '!src/engine/**', '!src/base/**', '!src/proofs/**', '!src/verify/**', '!src/stats/**']
GERUND_KEEP = ()
# Whose `axis` is something that a paper leaves open.
AXIS_FILES = ['src/analysis/across/*.rs', 'src/analysis/compare/run.rs', 'src/analysis/compare.rs', 'src/analysis/compare/tests.rs', 'src/page/readings.rs', 'src/page/body.rs', 'src/render/report/readings.rs',
    'src/study/manifest.rs', 'src/study/manifest/held.rs', 'src/study/merge.rs', 'tests/it/page/readings.rs', 'tests/it/characteristics/synthetic.rs']


def apply(tree):
    if not tree.has('src/study/*.rs', r'\bstruct Interpretation\b'):
        print('   choices are not in paper.toml yet: readings are left as they are')
        return
    both = ['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs']
    def text(files, p, r):
        for f in tree.match(files): tree.write(f, re.sub(p, r, tree.read(f)))

    # Types.
    for f in tree.match(['src/analysis/across/*.rs', 'src/page/*.rs', 'tests/it/**/*.rs']):
        src = tree.read(f)
        if re.search(r'\bAxisOption\b', src): tree.write(f, rename_idents(src, {'Axis': 'ExploredChoice', 'AxisOption': 'ExploredOption'}))
    text(['src/analysis/across/*.rs'], r'\bAxes\b', 'VotingChoices')
    text(['src/analysis/across/by_reading.rs'], r'\bpub fn axes\(', 'pub fn explored_choices(')
    text(['src/analysis/across/by_reading.rs'], r'\baxes\(paper\)', 'explored_choices(paper)')
    text(['src/page/readings.rs'], r'\bExploredOption, axes\}', 'ExploredOption, explored_choices}')
    text(['src/page/readings.rs'], r'\blet axes = axes\(paper\)', 'let axes = explored_choices(paper)')
    for f in tree.match(['src/analysis/across/by_reading.rs']):
        src = tree.read(f)
        i = src.find('pub fn explored_choices(')
        j = src.index('\n}\n', i)
        tree.write(f, src[:i] + rename_words(src[i:j], {'reading': 'choice', 'readings': 'choices'}) + src[j:])
    # Columns of keys: a choice each.
    for f in tree.match(['src/study/store/describe.rs']):
        src = rename_words(tree.read(f), {'reading': 'choice', 'readings': 'choices'})
        tree.write(f, each_text(src, subs([(r'"reading_"', '"choice_"'), (r'\breading\b', 'choice'), (r'\breadings\b', 'choices')])))
    text(['src/study/store/read.rs'], r'\{READING, SWEEP\}', '{CHOICE, SWEEP}')
    text(['src/study/store/read.rs'], r'named\(READING\)', 'named(CHOICE)')
    text(['src/study/store/table.rs'], r'\bREADING\b', 'CHOICE')
    text(['src/study/store/table.rs'], r'\breading_keys\b', 'choice_columns')
    text(['src/study/store/*.rs', 'src/study/*.rs', 'src/study/checked/*.rs', 'src/study/reuse/*.rs'], r'\bkeys\.readings\b', 'keys.choices')
    text(both, r'\bkey_columns\(\)\.readings\b', 'key_columns().choices')
    text(['src/study/key.rs'], r'pub readings: Vec<Text>', 'pub choices: Vec<Text>')
    text(['src/study/checked.rs'], r'\breadings: moving', 'choices: moving')
    text(both, r'(KeyColumns \{[^{}]*?)\breadings:', r'\1choices:')
    # An axis is a choice.
    for f in tree.match(AXIS_FILES):
        src = tree.read(f)
        accept = (lambda ts, i: True)
        if f.endswith('body.rs'): accept = lambda ts, i: ts[i][1] == 'axis'
        src = rename_words(src, {'axis': 'choice', 'axes': 'choices'}, accept=lambda ts, i: accept(ts, i) and len(ts[i][1]) < 12)
        tree.write(f, each_text(src, AXIS_PROSE))
    text(['src/analysis/witness.rs'], r'\baxes\b(?= that| of|\.retain|\)|, and|\s=)', 'choices')
    text(['src/analysis/witness.rs'], r'\|axis\| is_own\(axis\) \|\| reading\.options\(\)\.get\(&axis\.id\) != Some\(&axis\.default\)', '|choice| is_own(choice) || reading.options().get(&choice.id) != Some(&choice.default)')
    text(['src/analysis/witness.rs'], r'\|axis: &Choice\| hunt\.study\.choices\.iter\(\)\.any\(\|own\| own\.id == axis\.id\)', '|choice: &Choice| hunt.study.choices.iter().any(|own| own.id == choice.id)')
    # What is a choice under the name of a reading.
    for f in tree.match(['src/render/report/readings.rs']):
        src = rename_words(tree.read(f), {'reading': 'choice'})
        tree.write(f, src)
    for f in tree.match(['src/analysis/witness.rs']):
        src = tree.read(f)
        i = src.find('fn drawn(readings: &[Choice]')
        if i >= 0:
            j = src.index('\n}\n', i)
            body = src[i:j].replace('let choices =', 'let options =').replace('(readings, &choices)', '(choices, &options)')
            body = rename_words(body, {'reading': 'choice', 'readings': 'choices'})
            tree.write(f, src[:i] + body + src[j:])
    # Everything else: one option for every choice.
    for f in tree.match(NOT + both):
        src = tree.read(f)
        if not re.search('reading', src, re.I) or f.endswith('cli/mod.rs'): continue
        def accept(ts, i):
            t = ts[i][1]
            return t not in ('READING',) and not t.startswith('digits_survive') and len(t) < 30
        src = rename_words(src, {'reading': 'interpretation', 'readings': 'interpretations'}, accept=accept, keep=('READING',))
        tree.write(f, each_text(src, PROSE))
    for old, new in [('src/analysis/across/by_reading.rs', 'src/analysis/across/by_interpretation.rs'), ('src/page/readings.rs', 'src/page/interpretations.rs'), ('src/render/report/readings.rs', 'src/render/report/interpretations.rs'),
                     ('tests/it/counted_readings.rs', 'tests/it/counted_interpretations.rs'), ('tests/it/page/readings.rs', 'tests/it/page/interpretations.rs'), ('src/render/figure/claims_by_axes.rs', 'src/render/figure/claims_by_choices.rs'),
                     ('src/page/viewer/readings.js', 'src/page/viewer/interpretations.js')]:
        tree.move(old, new)
    base = subs([(r'"reading weight"', '"option weight"'), (r'with reading weight', 'with option weight'), (r'^"reading"$', '"choice"'), (r'there: readings, sweeps', 'there: options, sweeps'), (r'\(a reading or a sweep', '(an option or a sweep'),
        (r'under several readings is told', 'under several interpretations is told')])
    for f in tree.match(['src/base/settings/error.rs', 'src/base/settings/tests.rs', 'src/base/settings/validate.rs', 'tests/it/laws.rs']): tree.write(f, each_text(tree.read(f), base))
    page(tree)
    python(tree)
    specs(tree)
    text(both, r'\bclaims_by_axes\b', 'claims_by_choices')
    text(both, r'\bClaimsByAxes\b', 'ClaimsByChoices')
    for f in tree.match(['experiments/**/*.toml']):
        tree.write(f, tree.read(f).replace('"claims_by_axes"', '"claims_by_choices"'))


def page(tree):
    """The viewer's source; its bundle is built anew by src/page/bundle/build.sh."""
    js = subs([(r'\breadings\b', 'interpretations'), (r'\breading\b', 'interpretation'), (r'\bReadings\b', 'Interpretations'), (r'\bReading\b', 'Interpretation'), (r'\b([Aa]) interpretation\b', r'\1n interpretation'), (r'\baxes\b', 'choices'),
        (r'\baxis\b', 'choice'), (r'\bAXIS\b', 'CHOICE'), (r'\bdraws to say\b', 'instances to say')])
    for f in tree.match(['src/page/viewer/*.js', 'src/page/viewer/style.css']):
        src = tree.read(f)
        if re.search('reading', src, re.I) and not f.endswith(('arm.js', 'curves.js')): tree.write(f, js(src))


SPEC_PROSE = subs([(r'\bWhich reading moves\b', 'Which choice moves'), (r'\bmedian of 7 readings\b', 'median of 7 times'), (r'\bno reading of ties\b', 'no choice of ties'), (r'\beach reading of what\b', 'each option of what'),
    (r'\b([Ww])hich readings of what\b', r'\1hich options of what'), (r'\bWhich readings carry\b', 'Which interpretations carry'), (r'\bunder one reading\b', 'under one interpretation'), (r'\breadings of the search\b', 'options of the search'),
    (r'\bby options of the search\b', 'by option of the search'), (r'\bindices are readings of\b', 'indices are options of'), (r'\bIt is a reading\.', 'It is a choice.'), (r'\bevery other reading\b', 'every other interpretation'),
    (r'\bno reading that was explored\b', 'no interpretation that was explored'), (r'\bover all readings\b', 'over all interpretations'), (r'\bunder each reading\b', 'under each option'), (r'\bparts or readings\b', 'parts or choices'),
    (r'\bplainest reading\b', 'plainest interpretation'), (r'\bdirections, are readings\b', 'directions, are options'), (r'\band so no reading\b', 'and so no choice'), (r'\bother readings those\b', 'other choices those'),
    (r'\bdefault reading; they\b', 'default option; they'), (r'\bReadings show\b', 'Options show'), (r'\bits readings of the\b', 'its options of the'), (r'\ball readings: table', 'all interpretations: table'), (r'\bUnder every reading\b', 'Under every interpretation'),
    (r'\bunder every reading\b', 'under every interpretation'), (r'\bthe default reading\b', 'the default interpretation'), (r'\bone reading serves\b', 'one interpretation serves'), (r'\bmaps and readings looked\b', 'maps and interpretations looked'),
    (r'\bunless a reading says\b', 'unless an option says'), (r'\bby reading(?=[.,])', 'by interpretation'), (r'\(reading `', '(choice `'), (r'\bunder some readings\b', 'under some interpretations'), (r'\bpose-only reading\b', 'pose-only option'),
    (r'^(# )reading if its medians', r'\1interpretation if its medians'), (r'\bmatter of reading\b', 'matter of interpretation')])


def specs(tree):
    for f in tree.match(['experiments/**/*.toml', 'src/cli/new/**/*.toml']):
        lines, key = [], ''
        for line in tree.read(f).split('\n'):
            m = re.match(r'([A-Za-z_][\w.]*)\s*=', line)
            if m: key = m.group(1)
            elif line.startswith('['): key = ''
            if line.lstrip().startswith('#') or key in ('caption', 'table_caption', 'note', 'notes', 'why', 'question'): line = SPEC_PROSE(line)
            lines.append(line)
        tree.write(f, '\n'.join(lines))
    for f in tree.match(['docs/*.md', 'README.md']):
        if not f.endswith(('AUDIT.md', 'AUDIT_TABLES.md')): tree.write(f, PROSE(tree.read(f)))


def python(tree):
    words = subs([(r'\bno reading moves it\b', 'no choice moves it'), (r'"reading_"', '"choice_"'), (r'\bunder another reading\b', 'under another interpretation'), (r'\b([Aa]) reading\b', r'\1n interpretation'),
        (r'\bdefault readings\b', 'default interpretation'), (r'\bother readings than the defaults\b', 'other interpretations than the default'), (r'\bclock readings?\b', 'times'), (r'\bClock readings\b', 'Times'),
        (r'\breadings\b', 'interpretations'), (r'\breading\b(?! (the|a|files?)\b)', 'interpretation'), (r'\bReadings\b', 'Interpretations')])
    axes = subs([(r'\b(?<!\.)axis\b(?!=\d)', 'choice'), (r'\baxes\b', 'choices'), (r'\bAxis\b', 'Choice'), (r'\ban choice\b', 'a choice'), (r'\btest_an_axis\b', 'test_a_choice')])
    for f in tree.match(['crosscheck/statistics_judge/*.py', 'crosscheck/tests/test_across.py', 'crosscheck/tests/test_statistics_judge.py']):
        tree.write(f, words(tree.read(f)))
    for f in tree.match(['crosscheck/statistics_judge/across.py', 'crosscheck/statistics_judge/judge.py', 'crosscheck/statistics_judge/medians.py', 'crosscheck/tests/test_across.py']):
        tree.write(f, axes(tree.read(f)))
